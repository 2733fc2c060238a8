// Compiled once for every vector instruction set that includes it, hence the toggle instead of a #pragma once.
#if defined(HYBRIDRT_POINT_SHADE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_POINT_SHADE_H
#undef HYBRIDRT_POINT_SHADE_H
#else
#define HYBRIDRT_POINT_SHADE_H
#endif

#include "core/trace/point_paint-inl.h"
#include "core/trace/trace_job.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// The colour of a vector of points, from number `first`, without reflected and refracted rays. `normal`: their shading
/// normals. `lit`: one per point, bit l where light l arrives. Points: SeenPoints or HitSurfaces<float>.
template <typename Points>
LaneVec3<float> shaded(const TraceJob& job, const Points& points, int first, LaneVec3<float> normal,
                       const uint8_t* lit) {
  using Real = LaneReal<float>;
  using Vector = LaneVec3<float>;
  const LanePaint paint = PointPaint<Points>(job.scene, points, first).paint();
  const Vector dir = vector_at(points.dir, first);
  const Vector ambient =
      surface_floats::ambient_at(Vector::all(job.ambient.color), Vector::all(job.ambient.slope), normal);
  Vector color = surface_floats::phong_unlit(paint.kd, paint.ke, paint.opacity, ambient);
  for (size_t l = 0; l < job.lights.size(); ++l) {
    const DirectionalLight& light = job.lights[l].light;
    HWY_ALIGN float arrives[16];
    float any = 0;
    for (int i = 0; i < kFloatsAtOnce; ++i)
      any += arrives[i] = first + i < points.count ? static_cast<float>(lit[first + i] >> l & 1) : 0;
    if (any == 0) continue;
    const Vector brought = surface_floats::phong_light(paint.kd, paint.ks, paint.ns, paint.opacity, normal, -dir,
                                                       Vector::all(vec3(light.toward)), Vector::all(light.color));
    color = color + choose(Real::load(arrives) > Real(0), brought, Vector(Real(0)));
  }
  return color;
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
