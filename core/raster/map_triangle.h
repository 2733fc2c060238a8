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
  double w = 0;               ///< under kLeastW the others mean nothing
};

/// A map shows what has w >= 1 only. What lies behind the pole of its warp, where w < 0, must not be divided by w, and
/// what lies just before it would be very far away.
inline constexpr double kLeastW = 0.5;

MapCorner corner_on_map(const MapProjection& map, const vec3& position);

/// Texels of the map, inclusive; none if x0 > x1 or y0 > y1.
struct TexelBox {
  int x0, y0, x1, y1;
};

/// a x + b y + c
struct MapPlane {
  double a = 0, b = 0, c = 0;
  double at(double x, double y) const { return a * x + (b * y + c); }
};

/// A triangle as a map draws it: a texel is covered if its centre lies in the triangle or on its outline, so that what
/// lies beside an edge belongs to one of its two triangles however it is rounded.
struct MapTriangle {
  MapPlane edge[3];          ///< >= 0 inside; opposite corner 0, 1, 2
  double inverse_w[3];       ///< edge[i] * inverse_w[i] are in the ratio of the barycentric weights
  double x_px, y_px, depth;  ///< of a point of its plane ...
  double slope_x, slope_y;   ///< ... and how depth changes per texel
  double least_depth, most_depth;
  TexelBox box;  ///< of the map; what is covered lies in it
};

/// The texels whose centres may lie in `triangle`.
TexelBox box_on_map(const Scene& scene, const MapProjection& map, std::span<const MapCorner> corners,
                    uint32_t triangle);

/// Nothing for what covers no texel, degenerate or not finite. `corners`: of the scene's positions.
std::optional<MapTriangle> triangle_on_map(const Scene& scene, const MapProjection& map,
                                           std::span<const MapCorner> corners, uint32_t triangle);

}  // namespace hybridrt
