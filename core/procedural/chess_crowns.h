#pragma once

#include "core/procedural/turning.h"

namespace hybridrt {

// Heads of chess pieces that are more than turned work, as patches that close a turned body.

/// The rook's battlements, which stand on its wall from `low` to `high`.
struct RookCrown {
  double outer_radius, inner_radius, low, high;
};
inline constexpr RookCrown kRookCrown{0.252, 0.186, 0.855, 0.955};

/// `outside` ends and `inside` begins at the wall's two edges, at height kRookCrown.low.
std::vector<Patch> rook_patches(const Profile& outside, const Profile& inside, const Fineness& fineness);

/// A mitre with the bishop's cut and a ball on `body`, where that ends.
std::vector<Patch> bishop_patches(const Profile& body, const Fineness& fineness);

/// A circle whose lift cuts scallops between the points of the queen's coronet.
Outline coronet();

/// The king's cross, arms flared, standing at height `bottom`, broadside to x.
std::vector<Patch> cross_patches(double bottom, const Fineness& fineness);

}  // namespace hybridrt
