#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/base/math.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// How a map's texels lie in the scene: (u w, v w, z, w) = map_from_origin * (position - origin, 1), with u and v 0..1
/// over the map, whose rows have a constant w >= 1.
struct MapProjection {
  dvec3 origin{0};  ///< scene space
  dmat4 map_from_origin{1};
  int size_px = 0;  ///< texels along each side
};

/// A position of the scene on a map.
struct MapCorner {
  double x_px = 0, y_px = 0;  ///< texels; texel (0, 0) is 0..1
  double depth = 0;           ///< z / w
  double inverse_w = 0;       ///< 0: w is under kLeastW, and the others mean nothing
};

/// What lies behind the pole of the map's warp, where w < 0, must not be divided by w, and what lies just before it
/// would be very far away. The map shows neither.
inline constexpr double kLeastW = 0.5;

MapCorner corner_on_map(const MapProjection& map, const vec3& position);

/// Texels of the map, inclusive; none if x0 > x1 or y0 > y1.
struct TexelBox {
  int x0, y0, x1, y1;
  bool empty() const { return x0 > x1 || y0 > y1; }
};

/// a x + b y + c, of a place in texels.
struct MapPlane {
  double a = 0, b = 0, c = 0;
  double at(double x, double y) const { return a * x + (b * y + c); }
};

/// A triangle as a map draws it. A texel is covered if its centre is nowhere more than kReach_px outside, so that
/// single precision leaves no gap between neighbours. That is less than what GL snaps vertices by.
struct MapTriangle {
  MapPlane edge[3];          ///< opposite corner 0, 1, 2: about how many texels inside; |a| + |b| = 1
  double weight[3];          ///< edge[i] * weight[i] are in the ratio of the barycentric weights
  MapPlane depth;            ///< z / w ...
  double nearest, farthest;  ///< ... and its limits
  TexelBox box;              ///< texels that it may cover
};
inline constexpr double kReach_px = 1.0 / 8192;

/// MapTriangle::box.
TexelBox box_on_map(const Scene& scene, const MapProjection& map, std::span<const MapCorner> corners,
                    uint32_t triangle);

/// `box` is its box_on_map(). Nothing for what is narrower than kReach_px as the light sees it (its neighbours reach
/// over it) or not finite. `corners`: of the scene's positions.
std::optional<MapTriangle> triangle_on_map(const Scene& scene, const MapProjection& map,
                                           std::span<const MapCorner> corners, uint32_t triangle, const TexelBox& box);

}  // namespace hybridrt
