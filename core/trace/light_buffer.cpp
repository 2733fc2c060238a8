#include "core/trace/light_buffer.h"

#include <hwy/highway.h>
#include <limits>

#include "core/base/check.h"
#include "core/trace/holes.h"
#include "core/trace/light_cells.h"
#include "core/trace/triangle.h"

namespace hybridrt {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::FixedTag<int16_t, 4>;
constexpr Lanes kLanes;

class Lookup {
 public:
  explicit Lookup(const LightBuffer& buffer)
      : buffer_(buffer),
        // Only `origin` differs between the queries.
        ray_(shear_ray(dvec3(0), buffer.toward)) {}

  /// Queries wait for memory, so a group of them goes through each step together: first all cells are prefetched, then
  /// all first entries.
  static constexpr size_t kGroup = 16;
  void answer_group(const ShadowQuery* queries, size_t count, uint8_t* occluded) const {
    Place places[kGroup];
    find_places(queries, count, places);
    for (size_t i = 0; i < count; ++i)
      if (places[i].cell && places[i].depth >= places[i].cell->nearest)
        __builtin_prefetch(&buffer_.entries[places[i].cell->first]);
    for (size_t i = 0; i < count; ++i) occluded[i] = places[i].cell && is_occluded(queries[i], places[i]);
  }

  void answer_group(const ShadowQuery* queries, size_t count, CellAnswer* answers) const {
    Place places[kGroup];
    find_places(queries, count, places);
    for (size_t i = 0; i < count; ++i) answers[i] = answer_of_cell(queries[i], places[i]);
  }

  /// How often the ray leaves closed bodies, minus how often it enters them.
  int surplus_of_exits(const dvec3& origin) const {
    const ShadowQuery query{origin};
    const LightCell* cell = place_of(origin).cell;
    if (!cell) return 0;
    int surplus = 0;
    for (uint32_t i = cell->first; i < cell[1].first; ++i) surplus += exit_of(query, buffer_.entries[i].triangle);
    for (uint32_t i = cell->first_other; i < cell[1].first_other; ++i)
      surplus += exit_of(query, buffer_.others[i].triangle);
    return surplus;
  }

 private:
  struct Place {
    const LightCell* cell = nullptr;  ///< null outside the grid, where nothing is met
    float x, y, depth;                ///< in the cell's coordinates
  };

  void find_places(const ShadowQuery* queries, size_t count, Place* places) const {
    for (size_t i = 0; i < count; ++i) {
      places[i] = place_of(queries[i].origin);
      if (places[i].cell) __builtin_prefetch(places[i].cell);
    }
  }

  CellAnswer answer_of_cell(const ShadowQuery& query, const Place& place) const {
    if (!place.cell) return CellAnswer::lit;
    if (place.depth > place.cell->cover) return CellAnswer::shadow;
    if (query.anywhere || starts_inside(query)) return CellAnswer::inside;
    if (place.depth < place.cell->nearest) return CellAnswer::lit;
    return place.cell->single && is_open(query) ? CellAnswer::lit : CellAnswer::unknown;
  }

  Place place_of(const dvec3& origin) const {
    const dvec3 at = grid_from_light(buffer_, light_from_scene(buffer_, origin));
    if (!(at.x >= 0 && at.y >= 0 && at.x < 2.0 * buffer_.cells_x && at.y < 2.0 * buffer_.cells_y)) return {};
    const int i = static_cast<int>(0.5 * at.x), j = static_cast<int>(0.5 * at.y);
    Place place;
    place.cell = &buffer_.cells[static_cast<size_t>(j) * buffer_.cells_x + i];
    place.x = static_cast<float>(at.x - (2 * i + 1));
    place.y = static_cast<float>(at.y - (2 * j + 1));
    place.depth = static_cast<float>(std::clamp(at.z, -2.0, 2.0));  // all triangles lie in [-1, 1]
    return place;
  }

  bool is_occluded(const ShadowQuery& query, const Place& place) const {
    switch (answer_of_cell(query, place)) {
      case CellAnswer::lit: return false;
      case CellAnswer::shadow: return true;
      case CellAnswer::inside: return any_other(query, place) || any_entry(query, place);
      case CellAnswer::unknown: return any_entry(query, place);
    }
    return false;
  }

  bool any_entry(const ShadowQuery& query, const Place& place) const {
    const LightCell* cell = place.cell;
    const auto x = hn::Set(kLanes, as_fraction(place.x)), y = hn::Set(kLanes, as_fraction(place.y));
    constexpr int16_t kEdge = LightEntry::kEdgeError, kAny = std::numeric_limits<int16_t>::min();  // lane 3: below
    alignas(8) static constexpr int16_t kOutside[4] = {-kEdge, -kEdge, -kEdge, kAny},
                                        kInside[4] = {kEdge, kEdge, kEdge, kAny};
    const auto outside = hn::Load(kLanes, kOutside), inside = hn::Load(kLanes, kInside);
    for (uint32_t i = cell->first; i < cell[1].first; ++i) {
      const LightEntry& entry = buffer_.entries[i];
      if (place.depth < entry.nearest) return false;
      const auto across = hn::SaturatedAdd(hn::MulFixedPoint15(hn::Load(kLanes, entry.a), x),
                                           hn::MulFixedPoint15(hn::Load(kLanes, entry.b), y));
      const auto distance = hn::SaturatedAdd(across, hn::Load(kLanes, entry.c));
      if (!hn::AllFalse(kLanes, hn::Lt(distance, outside))) continue;  // certainly beside it
      const float units = entry.units_per_depth();
      const float below = static_cast<float>(entry.a[3]) * place.x + static_cast<float>(entry.b[3]) * place.y +
                          static_cast<float>(entry.c[3]) + (place.depth - entry.nearest) * units;
      const float error = LightEntry::kPlaneError + LightEntry::kDepthError * units;
      if (below < -error) continue;                    // certainly nearer to the light
      if (entry.triangle == query.triangle) continue;  // a plane does not shadow itself
      if ((below > error && hn::AllTrue(kLanes, hn::Gt(distance, inside))) || meets(query, entry.triangle)) return true;
    }
    return false;
  }

  /// In multiples of 2^-15, for MulFixedPoint15().
  static int16_t as_fraction(float value) {
    return static_cast<int16_t>(std::clamp(value, -1.0f, 0x0.FFFEp0f) * 0x1p15f);
  }

  /// 1 if the ray leaves a closed body by the triangle, -1 if it enters one, else 0.
  int exit_of(const ShadowQuery& query, uint32_t triangle) const {
    if (buffer_.sides[triangle] == 0 || !meets(query, triangle)) return 0;
    const Scene& scene = *buffer_.scene;
    const dvec3 a(scene.vertex(triangle, 0)), b(scene.vertex(triangle, 1)), c(scene.vertex(triangle, 2));
    const double facing = glm::dot(glm::cross(b - a, c - a), buffer_.toward);
    return facing > 0 ? buffer_.sides[triangle] : -buffer_.sides[triangle];
  }

  /// Whether the query starts on the inner side of its own triangle.
  bool starts_inside(const ShadowQuery& query) const {
    if (query.triangle == kNoTriangle) return false;
    const int8_t side = buffer_.sides[query.triangle];
    return query.from_front ? side < 0 : side > 0;
  }

  /// Whether the query leaves a triangle that belongs to no closed body; the cell then lists it.
  bool is_open(const ShadowQuery& query) const { return query.is_precise && buffer_.sides[query.triangle] == 0; }

  bool meets(const ShadowQuery& query, uint32_t triangle) const {
    const Scene& scene = *buffer_.scene;
    const uvec3& corners = scene.triangle_positions[triangle];
    const vec3 &a = scene.positions[corners.x], &b = scene.positions[corners.y], &c = scene.positions[corners.z];
    ShearedRay<double> ray = ray_;
    ray.origin = query.origin;
    if (is_beside(ray, a, b, c)) return false;
    TriangleHit<double> hit;
    return intersect_triangle(ray, a, b, c, hit) && hit.t > 0 &&
           !(scene.has_holes() && is_hole(*scene.textures, triangle, hit.u, hit.v));
  }

  bool any_other(const ShadowQuery& query, const Place& place) const {
    for (uint32_t i = place.cell->first_other; i < place.cell[1].first_other; ++i) {
      const LightOther& other = buffer_.others[i];
      if (place.depth < other.nearest) return false;
      if (other.triangle != query.triangle && meets(query, other.triangle)) return true;
    }
    return false;
  }

  const LightBuffer& buffer_;
  ShearedRay<double> ray_;
};

}  // namespace

void shadow_answers(const LightBuffer& buffer, std::span<const ShadowQuery> queries, std::span<uint8_t> occluded) {
  HRT_CHECK_EQ(queries.size(), occluded.size());
  const Lookup lookup(buffer);
  for (size_t i = 0; i < queries.size(); i += Lookup::kGroup)
    lookup.answer_group(&queries[i], std::min(Lookup::kGroup, queries.size() - i), &occluded[i]);
}

void answers_of_cells(const LightBuffer& buffer, std::span<const ShadowQuery> queries, std::span<CellAnswer> answers) {
  HRT_CHECK_EQ(queries.size(), answers.size());
  const Lookup lookup(buffer);
  for (size_t i = 0; i < queries.size(); i += Lookup::kGroup)
    lookup.answer_group(&queries[i], std::min(Lookup::kGroup, queries.size() - i), &answers[i]);
}

bool may_be_enclosed(const LightBuffer& buffer, const dvec3& eye) {
  // A ray through an edge meets both its triangles, and the sum is meaningless. That is common: scenes are symmetrical,
  // and cameras stand in the middle of them. A camera that lies on the floor sees both of its sides. So points around
  // the eye are asked, slightly off the places where edges tend to lie.
  const dvec3 size = glm::max(glm::abs(eye), dvec3(buffer.scene->bounds.extent()));
  const double step = 1e-9 * std::max({size.x, size.y, size.z});
  const Lookup lookup(buffer);
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (lookup.surplus_of_exits(eye + step * dvec3(x + 0.07, y - 0.11, z + 0.05)) != 0) return true;
  return false;
}

}  // namespace hybridrt
