#pragma once

#include "core/procedural/turning.h"

namespace hybridrt {

// The board's parts, each a closed surface; the playing surface lies at height 0.

inline constexpr double kBoardHeight = 0.30;  // above the table
inline constexpr double kAirUnderPieces = 0.002;

std::vector<Patch> board_square(const Fineness& fineness);     ///< around the origin
std::vector<Patch> board_core(const Fineness& fineness);       ///< the plate under the squares
std::vector<Patch> board_stringing(const Fineness& fineness);  ///< the light line around the squares
std::vector<Patch> board_frame(const Fineness& fineness);
/// `rings`: the number of rings of the table's top (>= 1), which is the last patch.
std::vector<Patch> table_round(const Fineness& fineness, int rings);

}  // namespace hybridrt
