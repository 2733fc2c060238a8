#include "core/procedural/chess_position.h"

#include "core/base/fixed_random.h"

namespace hybridrt {
namespace {

constexpr ChessPiece P = ChessPiece::pawn, R = ChessPiece::rook, N = ChessPiece::knight, B = ChessPiece::bishop,
                     Q = ChessPiece::queen, K = ChessPiece::king;
constexpr ChessFinish wood = ChessFinish::plain, glass = ChessFinish::glass, metal = ChessFinish::metal;

struct Square {
  ChessPiece piece;
  char file;
  int rank;
  double turn_deg;  ///< roughly as a player would leave it
  ChessFinish finish;
};

constexpr Square kWhite[] = {
    {R, 'a', 1, 90, wood},  {P, 'a', 2, 90, wood}, {P, 'c', 2, 90, wood},  {P, 'd', 3, 90, wood},
    {P, 'e', 4, 90, glass}, {K, 'f', 1, 70, wood}, {Q, 'f', 3, 90, glass}, {R, 'g', 1, 90, metal},
    {P, 'g', 4, 90, wood},  {P, 'h', 5, 90, wood}, {N, 'd', 5, 155, wood}, {N, 'f', 5, 40, wood},
    {B, 'd', 6, 60, metal},
};
constexpr Square kBlack[] = {
    {R, 'a', 8, 270, wood},  {N, 'b', 8, 300, wood},  {B, 'c', 8, 280, wood}, {K, 'e', 8, 290, wood},
    {N, 'g', 8, 235, wood},  {R, 'h', 8, 270, glass}, {P, 'a', 7, 0, wood},   {P, 'd', 7, 0, wood},
    {P, 'f', 7, 0, metal},   {P, 'g', 7, 0, wood},    {P, 'h', 7, 0, wood},   {P, 'b', 5, 0, metal},
    {B, 'c', 5, 330, glass}, {Q, 'b', 2, 0, glass},
};
// Taken: a bishop and two pawns of White's, two pawns of Black's.
constexpr ChessMan kTaken[] = {
    {B, true, {-5.55, -2.7}, 20, wood, true}, {P, true, {-5.75, -1.75}, 0, wood, true},
    {P, true, {-5.45, -3.6}, 0, glass, true}, {P, false, {5.55, 2.6}, 0, glass, true},
    {P, false, {5.80, 1.75}, 0, wood, true},
};

}  // namespace

std::vector<ChessMan> immortal_game() {
  std::vector<ChessMan> men;
  uint64_t state = 1851;
  const auto stand = [&](std::span<const Square> squares, bool white) {
    for (const Square& s : squares) {
      // Players do not put pieces exactly in the middle.
      const double dx = 0.09 * (next_unit(state) - 0.5), dz = 0.09 * (next_unit(state) - 0.5);
      const double turn_deg = s.turn_deg + 16 * (next_unit(state) - 0.5);
      men.push_back({s.piece, white, {s.file - 'a' - 3.5 + dx, 4.5 - s.rank + dz}, turn_deg, s.finish, false});
    }
  };
  stand(kWhite, true);
  stand(kBlack, false);
  men.insert(men.end(), std::begin(kTaken), std::end(kTaken));
  return men;
}

}  // namespace hybridrt
