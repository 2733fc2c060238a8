#pragma once

#include <span>

#include "core/procedural/chess_materials.h"
#include "core/procedural/chess_pieces.h"

namespace hybridrt {

/// One piece: where its middle is (x along the ranks from a to h, z from Black's side to White's), which way
/// its front looks (0: along +x, growing counter-clockwise seen from above), what it is made of.
struct ChessMan {
  ChessPiece piece;
  bool white;
  dvec2 place{0};
  double turn_deg;
  ChessFinish finish;
  bool captured;  ///< stands on the table
};

/// The whole set of 32.
std::vector<ChessMan> immortal_game();

}  // namespace hybridrt
