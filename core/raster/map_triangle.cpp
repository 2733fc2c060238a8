#include "core/raster/map_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybridrt {
namespace {

/// x and y in texels times w, and w; z of MapProjection.
struct HomogeneousCorner {
  dvec3 place;
  double z;
};

HomogeneousCorner homogeneous_corner(const MapProjection& map, const vec3& position) {
  const dvec4 q = map.map_from_origin * dvec4(dvec3(position) - map.origin, 1);
  return {dvec3(q.x * map.size_px, q.y * map.size_px, q.w), q.z};
}

/// The texels whose centres lie within reach of a range, from the first to the last of the map; a bound that is no
/// number bounds nothing.
TexelBox box_of(const dvec2& lo, const dvec2& hi, int size_px) {
  const double last = size_px - 1;
  const auto first_of = [&](double v) {
    return static_cast<int>(std::min(last + 1, std::max(0.0, std::ceil(v - kReach_px - 0.5))));
  };
  const auto last_of = [&](double v) {
    return static_cast<int>(std::max(-1.0, std::min(last, std::floor(v + kReach_px - 0.5))));
  };
  return {first_of(lo.x), first_of(lo.y), last_of(hi.x), last_of(hi.y)};
}

/// Divides the plane by |a| + |b|, which is returned.
double normalize(MapPlane& edge) {
  const double norm = std::abs(edge.a) + std::abs(edge.b), scale = 1 / norm;
  edge = {edge.a * scale, edge.b * scale, edge.c * scale};
  return norm;
}

using Corners = std::array<const MapCorner*, 3>;

Corners corners_of(const Scene& scene, std::span<const MapCorner> corners, uint32_t triangle) {
  const uvec3& t = scene.triangle_positions[triangle];
  return {&corners[t[0]], &corners[t[1]], &corners[t[2]]};
}

bool lies_before_pole(const Corners& c) { return c[0]->inverse_w > 0 && c[1]->inverse_w > 0 && c[2]->inverse_w > 0; }

bool projected(const Corners& corners, MapTriangle& t) {
  const MapCorner &p = *corners[0], &q = *corners[1], &r = *corners[2];
  const dvec2 e1(q.x_px - p.x_px, q.y_px - p.y_px), e2(r.x_px - p.x_px, r.y_px - p.y_px);
  const double area = e1.x * e2.y - e2.x * e1.y, d1 = q.depth - p.depth, d2 = r.depth - p.depth;
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const MapCorner &from = *corners[(i + 1) % 3], &to = *corners[(i + 2) % 3];
    const double a = from.y_px - to.y_px, b = to.x_px - from.x_px, sign = area < 0 ? -1 : 1;
    t.edge[i] = {sign * a, sign * b, -sign * (a * from.x_px + b * from.y_px)};
    const double norm = normalize(t.edge[i]);
    t.weight[i] = norm * corners[i]->inverse_w;
    longest = std::max(longest, norm);
  }
  if (!(std::abs(area) > kReach_px * longest)) return false;
  const double inverse_area = 1 / area;
  t.depth.a = (d1 * e2.y - d2 * e1.y) * inverse_area;
  t.depth.b = (d2 * e1.x - d1 * e2.x) * inverse_area;
  t.depth.c = p.depth - t.depth.a * p.x_px - t.depth.b * p.y_px;
  t.nearest = std::min({p.depth, q.depth, r.depth}), t.farthest = std::max({p.depth, q.depth, r.depth});
  return std::isfinite(t.depth.c);
}

/// What reaches over the pole: homogeneous edge functions, which need no clipping (Olano and Greer, "Triangle Scan
/// Conversion using 2D Homogeneous Coordinates", 1997).
bool homogeneous(const std::array<HomogeneousCorner, 3>& q, MapTriangle& t) {
  const double volume = glm::dot(q[0].place, glm::cross(q[1].place, q[2].place)), sign = volume < 0 ? -1 : 1;
  t.depth = {};
  for (int i = 0; i < 3; ++i) {
    const dvec3 edge = glm::cross(q[(i + 1) % 3].place, q[(i + 2) % 3].place);
    t.edge[i] = {sign * edge.x, sign * edge.y, sign * edge.z};
    t.weight[i] = normalize(t.edge[i]);
    const double share = q[i].z / volume;
    t.depth.a += edge.x * share, t.depth.b += edge.y * share, t.depth.c += edge.z * share;
  }
  t.nearest = -1, t.farthest = 1;
  return std::isfinite(t.depth.a) && std::isfinite(t.depth.b) && std::isfinite(t.depth.c);
}

std::array<HomogeneousCorner, 3> homogeneous_corners(const Scene& scene, const MapProjection& map, uint32_t triangle) {
  return {homogeneous_corner(map, scene.vertex(triangle, 0)), homogeneous_corner(map, scene.vertex(triangle, 1)),
          homogeneous_corner(map, scene.vertex(triangle, 2))};
}

/// Of the triangle's part with w >= kLeastW.
TexelBox box_before_pole(const std::array<HomogeneousCorner, 3>& corners, int size_px) {
  dvec2 lo(std::numeric_limits<double>::infinity()), hi = -lo;
  const auto grow = [&](const dvec3& place) {
    lo = glm::min(lo, dvec2(place) / place.z), hi = glm::max(hi, dvec2(place) / place.z);
  };
  for (int i = 0; i < 3; ++i) {
    const dvec3 &p = corners[i].place, &q = corners[(i + 1) % 3].place;
    if (p.z >= kLeastW) grow(p);
    if ((p.z >= kLeastW) != (q.z >= kLeastW)) {
      const dvec3 cut = p + (kLeastW - p.z) / (q.z - p.z) * (q - p);
      grow({cut.x, cut.y, kLeastW});
    }
  }
  return box_of(lo, hi, size_px);
}

}  // namespace

MapCorner corner_on_map(const MapProjection& map, const vec3& position) {
  const HomogeneousCorner corner = homogeneous_corner(map, position);
  if (!(corner.place.z >= kLeastW)) return {};
  const double inverse_w = 1 / corner.place.z;
  return {corner.place.x * inverse_w, corner.place.y * inverse_w, corner.z * inverse_w, inverse_w};
}

TexelBox box_on_map(const Scene& scene, const MapProjection& map, std::span<const MapCorner> corners,
                    uint32_t triangle) {
  const Corners c = corners_of(scene, corners, triangle);
  if (!lies_before_pole(c)) return box_before_pole(homogeneous_corners(scene, map, triangle), map.size_px);
  return box_of({std::min({c[0]->x_px, c[1]->x_px, c[2]->x_px}), std::min({c[0]->y_px, c[1]->y_px, c[2]->y_px})},
                {std::max({c[0]->x_px, c[1]->x_px, c[2]->x_px}), std::max({c[0]->y_px, c[1]->y_px, c[2]->y_px})},
                map.size_px);
}

std::optional<MapTriangle> triangle_on_map(const Scene& scene, const MapProjection& map,
                                           std::span<const MapCorner> corners, uint32_t triangle, const TexelBox& box) {
  std::optional<MapTriangle> t(std::in_place);
  t->box = box;
  const Corners c = corners_of(scene, corners, triangle);
  if (!(lies_before_pole(c) ? projected(c, *t) : homogeneous(homogeneous_corners(scene, map, triangle), *t))) t.reset();
  return t;
}

}  // namespace hybridrt
