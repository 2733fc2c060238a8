#include "core/passes_cpu/shade.h"

#include "core/base/check.h"
#include "core/trace/surface_at.h"

// clang-format off: the order matters
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/passes_cpu/shade.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

#include "core/trace/point_paint-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

using Real = LaneReal<float>;
using Vector = LaneVec3<float>;

class LaneShader {
 public:
  LaneShader(const TraceJob& job, const SeenPoints& points, const uint8_t* lit)
      : job_(job), scene_(job.scene), points_(points), lit_(lit) {}

  Vector color(int first) const {
    const Vector dir = vector_at(points_.dir, first), side = vector_at(points_.side, first);
    const Vector normal =
        surface_floats::turned_toward(surface_floats::normalized_or(interpolated_normal(first), side), side);
    const LanePaint paint = PointPaint(scene_, points_, first).paint();
    const Vector ambient =
        surface_floats::ambient_at(Vector::all(job_.ambient.color), Vector::all(job_.ambient.slope), normal);
    Vector color = surface_floats::phong_unlit(paint.kd, paint.ke, paint.opacity, ambient);
    for (size_t l = 0; l < job_.lights.size(); ++l) {
      const DirectionalLight& light = job_.lights[l].light;
      HWY_ALIGN float arrives[16];
      float any = 0;
      for (int i = 0; i < kFloatsAtOnce; ++i)
        any += arrives[i] = first + i < points_.count ? static_cast<float>(lit_[first + i] >> l & 1) : 0;
      if (any == 0) continue;
      const Vector brought = surface_floats::phong_light(paint.kd, paint.ks, paint.ns, paint.opacity, normal, -dir,
                                                         Vector::all(vec3(light.toward)), Vector::all(light.color));
      color = color + choose(Real::load(arrives) > Real(0), brought, Vector(Real(0)));
    }
    return color;
  }

 private:
  Vector interpolated_normal(int first) const {
    LaneTriples corner[3];
    for (int i = 0; i < kFloatsAtOnce; ++i) {
      const uvec3& numbers = scene_.triangle_normals[points_.triangle[first + i]];
      for (int k = 0; k < 3; ++k) corner[k].set(i, scene_.normals[numbers[k]]);
    }
    const Real u = Real::load(points_.u + first), v = Real::load(points_.v + first);
    return (Real(1) - u - v) * corner[0].load() + u * corner[1].load() + v * corner[2].load();
  }

  const TraceJob& job_;
  const Scene& scene_;
  const SeenPoints& points_;
  const uint8_t* const lit_;
};

void shade_in_lanes(const TraceJob& job, const SeenPoints& points, const uint8_t* lit,
                    float (&colors)[3][SeenPoints::kRoom]) {
  const LaneShader shader(job, points, lit);
  for (int first = 0; first < points.count; first += kFloatsAtOnce) {
    const Vector color = shader.color(first);
    color.x.store(colors[0] + first), color.y.store(colors[1] + first), color.z.store(colors[2] + first);
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
