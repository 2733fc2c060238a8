#include "core/trace/hit_shading.h"

// clang-format off: the order matters
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/hit_shading.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

#include "core/trace/point_shade-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

void shade_hits_in_lanes(const TraceJob& job, const HitSurfaces<float>& hits, const uint8_t* lit,
                         float (&colors)[3][HitSurfaces<float>::kRoom]) {
  for (int first = 0; first < hits.count; first += kFloatsAtOnce)
    store_at(shaded(job, hits, first, vector_at(hits.normal, first), lit), colors, first);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridrt {
namespace {

SurfaceColors<double> paint_of(const Scene& scene, const HitSurfaces<double>& hits, int i) {
  if (scene.materials[hits.material[i]].texture_maps == 0)
    return plain_colors(scene, hits.triangle[i], hits.u[i], hits.v[i]);
  return textured_colors(scene, hits.triangle[i], hits.u[i], hits.v[i], hits.dir_of(i), hits.solid_angle[i],
                         hits.distance[i]);
}

dvec3 color_of(const TraceJob& job, const HitSurfaces<double>& hits, int i, unsigned lit) {
  const Surface<double> surface = hits.surface(i);
  const Material& m = job.scene.materials[surface.material];
  const SurfaceColors<double> paint = paint_of(job.scene, hits, i);
  dvec3 color = phong_unlit(paint.kd, paint.ke, double(m.opacity),
                            ambient_at(dvec3(job.ambient.color), dvec3(job.ambient.slope), surface.normal));
  for (size_t l = 0; l < job.lights.size(); ++l)
    if (lit >> l & 1)
      color += phong_light(paint.kd, paint.ks, double(m.ns), double(m.opacity), surface.normal, -hits.dir_of(i),
                           job.lights[l].light.toward, dvec3(job.lights[l].light.color));
  return color;
}

}  // namespace

HWY_EXPORT(shade_hits_in_lanes);

void shade_hits(const TraceJob& job, const HitSurfaces<float>& hits, const uint8_t* lit,
                float (&colors)[3][HitSurfaces<float>::kRoom]) {
  HWY_DYNAMIC_DISPATCH(shade_hits_in_lanes)(job, hits, lit, colors);
}

void shade_hits(const TraceJob& job, const HitSurfaces<double>& hits, const uint8_t* lit,
                double (&colors)[3][HitSurfaces<double>::kRoom]) {
  for (int i = 0; i < hits.count; ++i) {
    const dvec3 color = color_of(job, hits, i, lit[i]);
    for (int k = 0; k < 3; ++k) colors[k][i] = color[k];
  }
}

}  // namespace hybridrt
#endif  // HWY_ONCE
