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

/// The texels whose centres lie in a range, from the first to the last of the map; a bound that is no number bounds
/// nothing.
TexelBox box_of(const dvec2& lo, const dvec2& hi, int size_px) {
  const double last = size_px - 1;
  const auto first_of = [&](double v) {
    return static_cast<int>(std::min(last + 1, std::max(0.0, std::ceil(v - 0.5))));
  };
  const auto last_of = [&](double v) { return static_cast<int>(std::max(-1.0, std::min(last, std::floor(v - 0.5)))); };
  return {first_of(lo.x), first_of(lo.y), last_of(hi.x), last_of(hi.y)};
}

/// The same numbers but for the sign for both triangles of an edge, which makes neighbours watertight.
MapPlane plane_of_edge(const MapCorner& p, const MapCorner& q) {
  const bool swapped = q.x_px < p.x_px || (q.x_px == p.x_px && q.y_px < p.y_px);
  const MapCorner &from = swapped ? q : p, &to = swapped ? p : q;
  const double a = from.y_px - to.y_px, b = to.x_px - from.x_px, c = -(a * from.x_px + b * from.y_px);
  return swapped ? MapPlane{-a, -b, -c} : MapPlane{a, b, c};
}

void turn_inside(MapPlane& edge, bool turned) {
  if (turned) edge = {-edge.a, -edge.b, -edge.c};
}

using Corners = std::array<const MapCorner*, 3>;

Corners corners_of(const Scene& scene, std::span<const MapCorner> corners, uint32_t triangle) {
  const uvec3& t = scene.triangle_positions[triangle];
  return {&corners[t[0]], &corners[t[1]], &corners[t[2]]};
}

bool lies_before_pole(const Corners& c) { return c[0]->w >= kLeastW && c[1]->w >= kLeastW && c[2]->w >= kLeastW; }

bool projected(const Corners& corners, MapTriangle& t) {
  const MapCorner &p = *corners[0], &q = *corners[1], &r = *corners[2];
  const dvec2 e1(q.x_px - p.x_px, q.y_px - p.y_px), e2(r.x_px - p.x_px, r.y_px - p.y_px);
  const double area = e1.x * e2.y - e2.x * e1.y, d1 = q.depth - p.depth, d2 = r.depth - p.depth;
  t.slope_x = (d1 * e2.y - d2 * e1.y) / area;
  t.slope_y = (d2 * e1.x - d1 * e2.x) / area;
  if (!std::isfinite(t.slope_x) || !std::isfinite(t.slope_y)) return false;
  t.x_px = p.x_px, t.y_px = p.y_px, t.depth = p.depth;
  t.least_depth = std::min({p.depth, q.depth, r.depth}), t.most_depth = std::max({p.depth, q.depth, r.depth});
  for (int i = 0; i < 3; ++i) {
    t.edge[i] = plane_of_edge(*corners[(i + 1) % 3], *corners[(i + 2) % 3]);
    turn_inside(t.edge[i], area < 0);
    t.inverse_w[i] = 1 / corners[i]->w;
  }
  return true;
}

/// What reaches over the pole: homogeneous edge functions, which need no clipping (Olano and Greer, "Triangle Scan
/// Conversion using 2D Homogeneous Coordinates", 1997).
bool homogeneous(const std::array<HomogeneousCorner, 3>& q, MapTriangle& t) {
  const double volume = glm::dot(q[0].place, glm::cross(q[1].place, q[2].place));
  MapPlane depth;
  for (int i = 0; i < 3; ++i) {
    const dvec3 edge = glm::cross(q[(i + 1) % 3].place, q[(i + 2) % 3].place);
    t.edge[i] = {edge.x, edge.y, edge.z};
    turn_inside(t.edge[i], volume < 0);
    t.inverse_w[i] = 1;
    const double share = q[i].z / volume;
    depth.a += edge.x * share, depth.b += edge.y * share, depth.c += edge.z * share;
  }
  if (!std::isfinite(depth.a) || !std::isfinite(depth.b) || !std::isfinite(depth.c)) return false;
  t.x_px = t.y_px = 0;
  t.depth = depth.c, t.slope_x = depth.a, t.slope_y = depth.b;
  t.least_depth = -1, t.most_depth = 1;
  return true;
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
  const double w = corner.place.z;
  return {corner.place.x / w, corner.place.y / w, corner.z / w, w};
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
                                           std::span<const MapCorner> corners, uint32_t triangle) {
  std::optional<MapTriangle> t(std::in_place);
  t->box = box_on_map(scene, map, corners, triangle);
  if (t->box.x0 > t->box.x1 || t->box.y0 > t->box.y1) return std::nullopt;
  const Corners c = corners_of(scene, corners, triangle);
  const bool drawn =
      lies_before_pole(c) ? projected(c, *t) : homogeneous(homogeneous_corners(scene, map, triangle), *t);
  if (!drawn) t.reset();
  return t;
}

}  // namespace hybridrt
