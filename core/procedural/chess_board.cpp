#include "core/procedural/chess_board.h"

namespace hybridrt {
namespace {

constexpr double kAir = 0.002;
constexpr double kQuarter = 0.41421356237309503;  // the bulge of a quarter circle
constexpr double kSquareDepth = 0.10;

}  // namespace

std::vector<Patch> board_square(const Fineness& fineness) {
  constexpr double kHalf = 0.5 - kAir, kBevel = 0.010;
  Profile p({0, -kSquareDepth});
  p.line({kHalf, -kSquareDepth}).line({kHalf, -kBevel}).arc({kHalf - kBevel, 0}, kQuarter).line({0, 0});
  return turned(p, square(), fineness);
}

std::vector<Patch> board_core(const Fineness& fineness) {
  constexpr double kTop = -kSquareDepth - kAir, kBottom = kAir - kBoardHeight;
  Profile p({0, kBottom});
  p.line({4, kBottom}).line({4, kTop}).line({0, kTop});
  return turned(p, square(), fineness);
}

std::vector<Patch> board_stringing(const Fineness& fineness) {
  constexpr double kIn = 4 + kAir, kOut = 4.055;
  Profile p({kIn, -kSquareDepth});
  p.line({kOut, -kSquareDepth}).line({kOut, 0}).line({kIn, 0}).line({kIn, -kSquareDepth});
  return turned(p, square(), fineness);
}

std::vector<Patch> board_frame(const Fineness& fineness) {
  constexpr double kIn = 4.055 + kAir, kOut = 4.74, kBottom = kAir - kBoardHeight;
  Profile p({kIn, kBottom});
  p.line({kOut + 0.05, kBottom}).arc({kOut + 0.08, kBottom + 0.03}, kQuarter).line({kOut + 0.08, kBottom + 0.08});
  p.arc({kOut + 0.05, kBottom + 0.11}, kQuarter).line({kOut + 0.035, kBottom + 0.11});
  p.arc({kOut, kBottom + 0.18}, -0.36).line({kOut, -0.035}).arc({kOut - 0.035, 0}, kQuarter);
  p.line({kIn + 0.006, 0}).line({kIn, -0.006}).line({kIn, kBottom});
  return turned(p, square(), fineness);
}

std::vector<Patch> table_round(const Fineness& fineness, int rings) {
  constexpr double kRadius = 8.6, kTop = -kBoardHeight, kThick = 0.42;
  Outline rim = circle();
  rim.fewest_columns = 48;
  Profile p({0, kTop - kThick});
  p.line({kRadius - 0.4, kTop - kThick})
      .curve({kRadius - 0.2, kTop - kThick}, {kRadius - 0.12, kTop - 0.25}, {kRadius - 0.1, kTop - 0.2});
  p.line({kRadius, kTop - 0.2}).line({kRadius, kTop - 0.06}).arc({kRadius - 0.06, kTop}, kQuarter).line({0, kTop});
  std::vector<Patch> patches = turned(p, rim, fineness);
  patches.back().rows = rings;
  return patches;
}

}  // namespace hybridrt
