#include "core/passes_cpu/shade.h"

#include "core/base/check.h"
#include "core/trace/surface_at.h"

// clang-format off: the order matters
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/passes_cpu/shade.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

#include "core/trace/point_shade-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

using Real = LaneReal<float>;
using Vector = LaneVec3<float>;

Vector interpolated_normal(const Scene& scene, const SeenPoints& points, int first) {
  LaneTriples corner[3];
  for (int i = 0; i < kFloatsAtOnce; ++i) {
    const uvec3& numbers = scene.triangle_normals[points.triangle[first + i]];
    for (int k = 0; k < 3; ++k) corner[k].set(i, scene.normals[numbers[k]]);
  }
  const Real u = Real::load(points.u + first), v = Real::load(points.v + first);
  return (Real(1) - u - v) * corner[0].load() + u * corner[1].load() + v * corner[2].load();
}

void shade_in_lanes(const TraceJob& job, const SeenPoints& points, const uint8_t* lit,
                    float (&colors)[3][SeenPoints::kRoom]) {
  for (int first = 0; first < points.count; first += kFloatsAtOnce) {
    const Vector side = vector_at(points.side, first);
    const Vector normal = surface_floats::turned_toward(
        surface_floats::normalized_or(interpolated_normal(job.scene, points, first), side), side);
    store_at(shaded(job, points, first, normal, lit), colors, first);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridrt {

HWY_EXPORT(shade_in_lanes);

void shade(const TraceJob& job, const SeenPoints& points, std::span<const uint8_t> lit,
           float (&colors)[3][SeenPoints::kRoom]) {
  HRT_CHECK(lit.size() >= static_cast<size_t>(points.count));
  HWY_DYNAMIC_DISPATCH(shade_in_lanes)(job, points, lit.data(), colors);
}

}  // namespace hybridrt
#endif  // HWY_ONCE
