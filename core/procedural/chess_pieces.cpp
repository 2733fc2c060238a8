#include "core/procedural/chess_pieces.h"

#include "core/procedural/chess_crowns.h"

namespace hybridrt {
namespace {

constexpr double kQuarter = 0.41421356237309503;  // the bulge of a quarter circle
constexpr double kAir = 0.0015;                   // between parts of a piece

/// The foot that all pieces share: a rounded plinth, a fillet, a cove and a ring, 0.235 high.
Profile foot(double radius) {
  Profile p({0, 0});
  p.line({radius - 0.02, 0}).arc({radius, 0.02}, kQuarter).line({radius, 0.062});
  p.arc({radius - 0.045, 0.107}, kQuarter).line({radius - 0.056, 0.107}).line({radius - 0.056, 0.118});
  p.arc({radius - 0.088, 0.165}, -0.33).line({radius - 0.082, 0.165}).bead(0.042, 0.021);
  p.line({radius - 0.094, 0.207}).line({radius - 0.094, 0.218});
  return p;
}

/// The concave stem from the foot up to a neck.
Profile& stem(Profile& p, double neck_radius, double neck_height) {
  const dvec2 from = p.end();
  const double rise = neck_height - from.y;
  return p.curve({from.x - 0.45 * (from.x - neck_radius), from.y + 0.10 * rise}, {neck_radius, from.y + 0.42 * rise},
                 {neck_radius, neck_height});
}

/// A collar: a flared underside, a sharp-edged disc, and a thinner ring on top; ends on `top_radius`.
Profile& collar(Profile& p, double radius, double top_radius) {
  const dvec2 from = p.end();
  p.curve({from.x + 0.002, from.y + 0.03}, {radius - 0.04, from.y + 0.045}, {radius, from.y + 0.05});
  p.bead(0.026, 0.012);
  const double y = from.y + 0.076;
  p.arc({radius - 0.05, y + 0.02}, -0.12).line({radius - 0.056, y + 0.02}).bead(0.03, 0.015);
  return p.line({top_radius, y + 0.05});
}

Profile pawn() {
  Profile p = foot(0.275);
  stem(p, 0.088, 0.50);
  const double y = p.end().y;
  p.curve({0.090, y + 0.02}, {0.15, y + 0.028}, {0.178, y + 0.034}).bead(0.026, 0.012);
  p.curve({0.150, y + 0.068}, {0.095, y + 0.07}, {0.088, y + 0.085});
  return p.ball(0.158);
}

std::vector<Patch> rook(const Fineness& fineness) {
  Profile p = foot(0.315);
  stem(p, 0.168, 0.60);
  p.line({0.180, 0.60}).bead(0.03, 0.015).line({0.172, 0.63});
  p.curve({0.174, 0.68}, {0.236, 0.69}, {0.246, 0.735}).line({0.252, 0.735});
  p.line({0.252, kRookCrown.low});
  Profile inside({kRookCrown.inner_radius, kRookCrown.low});
  inside.line({kRookCrown.inner_radius, kRookCrown.low - 0.045});
  inside.curve({0.12, 0.80}, {0.05, 0.82}, {0, 0.822});
  return rook_patches(p, inside, fineness);
}

std::vector<Patch> bishop(const Fineness& fineness) {
  Profile p = foot(0.31);
  stem(p, 0.098, 0.72);
  collar(p, 0.205, 0.100);
  const double y = p.end().y;
  p.line({0.100, y + 0.018}).line({0.112, y + 0.018}).bead(0.026, 0.013).line({0.098, y + 0.044});
  return bishop_patches(p, fineness);
}

std::vector<Patch> queen(const Fineness& fineness) {
  Profile p = foot(0.35);
  stem(p, 0.108, 0.90);
  collar(p, 0.228, 0.112);
  double y = p.end().y;
  p.line({0.112, y + 0.016}).line({0.128, y + 0.016}).bead(0.028, 0.014).line({0.112, y + 0.044});
  y = p.end().y;
  // The cup flares toward the coronet's points.
  p.curve({0.112, y + 0.12}, {0.150, y + 0.17}, {0.192, y + 0.215});
  p.lift(1).curve({0.205, y + 0.232}, {0.224, y + 0.255}, {0.238, y + 0.285});
  p.line({0.214, y + 0.291}).lift(0).curve({0.200, y + 0.275}, {0.188, y + 0.262}, {0.178, y + 0.252});
  // Inside it a dome with a ball.
  p.curve({0.150, y + 0.31}, {0.075, y + 0.333}, {0.036, y + 0.337}).ball(0.052);
  return turned(p, coronet(), fineness);
}

Profile king() {
  Profile p = foot(0.365);
  stem(p, 0.115, 0.99);
  collar(p, 0.240, 0.120);
  double y = p.end().y;
  p.line({0.120, y + 0.016}).line({0.138, y + 0.016}).bead(0.03, 0.015).line({0.122, y + 0.046});
  y = p.end().y;
  p.curve({0.124, y + 0.10}, {0.170, y + 0.17}, {0.205, y + 0.235}).line({0.216, y + 0.235}).bead(0.024, 0.01);
  p.line({0.198, y + 0.259}).curve({0.170, y + 0.292}, {0.09, y + 0.300}, {0.064, y + 0.318});
  p.line({0.074, y + 0.318}).bead(0.026, 0.013).line({0.05, y + 0.344});
  return p.curve({0.045, y + 0.356}, {0.02, y + 0.36}, {0, y + 0.36});
}

Profile knight() {
  Profile p = foot(0.325);
  p.line({0.262, 0.218}).bead(0.032, 0.016).line({kKnightFootRadius, 0.25});
  return p.line({kKnightFootRadius, kKnightFootHeight}).line({0, kKnightFootHeight});
}

}  // namespace

std::vector<std::vector<Patch>> turned_parts(ChessPiece piece, const Fineness& fineness) {
  switch (piece) {
    case ChessPiece::pawn: return {turned(pawn(), circle(), fineness)};
    case ChessPiece::rook: return {rook(fineness)};
    case ChessPiece::knight: return {turned(knight(), circle(), fineness)};
    case ChessPiece::bishop: return {bishop(fineness)};
    case ChessPiece::queen: return {queen(fineness)};
    case ChessPiece::king: break;
  }
  const Profile body = king();
  return {turned(body, circle(), fineness), cross_patches(body.end().y + kAir, fineness)};
}

}  // namespace hybridrt
