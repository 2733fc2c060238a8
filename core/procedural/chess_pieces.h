#pragma once

#include "core/procedural/turning.h"

namespace hybridrt {

enum class ChessPiece { pawn, rook, knight, bishop, queen, king };
inline constexpr int kChessPieces = 6;

/// The turned parts of a piece, each a closed surface: y up, the middle of its foot at the origin, in
/// widths of a square; what has a front faces +x. All but the king (whose cross is a part of its own) and the
/// knight (whose head is carved, see chess_knight.h) are one part.
std::vector<std::vector<Patch>> turned_parts(ChessPiece piece, const Fineness& fineness);

/// Where the knight's head begins: the top of its foot, and its radius there.
inline constexpr double kKnightFootHeight = 0.262, kKnightFootRadius = 0.235;

}  // namespace hybridrt
