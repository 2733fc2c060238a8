#include "core/trace/hit_surfaces.h"

#include "core/base/check.h"
#include "core/trace/scatter.h"

// clang-format off: the order matters
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/hit_surfaces.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

#include "core/trace/surface_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

using Real = LaneReal<float>;
using Vector = LaneVec3<float>;
using Hits = HitSurfaces<float>;
constexpr int kFloats = lane_count<float>();

inline Real::Mask mask_of(const uint8_t* flags) {
  HWY_ALIGN float values[16];
  for (int i = 0; i < kFloats; ++i) values[i] = flags[i];
  return Real::load(values) > Real(0);
}
inline void store_flags(Real::Mask mask, uint8_t* flags) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(LanesOf<float>(), mask, bits);
  for (int i = 0; i < kFloats; ++i) flags[i] = bits[i / 8] >> i % 8 & 1;
}

void find_in_lanes(const Scene& scene, Hits& hits) {
  for (int first = 0; first < hits.count; first += kFloats) {
    LaneTriples p[3], n[3];
    for (int i = 0; i < kFloats; ++i) {
      const uint32_t triangle = hits.triangle[first + i];
      const uvec3 corners = scene.triangle_positions[triangle], normals = scene.triangle_normals[triangle];
      for (int k = 0; k < 3; ++k) {
        p[k].set(i, scene.positions[corners[k]]);
        n[k].set(i, scene.normals[normals[k]]);
      }
      hits.material[first + i] = scene.triangle_materials[triangle];
    }
    const auto met = surface_floats::met_surface(p[0].load(), p[1].load(), p[2].load(), n[0].load(), n[1].load(),
                                                 n[2].load(), Real::load(hits.u + first), Real::load(hits.v + first),
                                                 vector_at(hits.dir, first), Real(kRelativeOffset<float>));
    store_at(met.point, hits.point, first), store_at(met.side, hits.side, first),
        store_at(met.normal, hits.normal, first);
    met.offset.store(hits.offset + first);
    store_flags(met.from_outside, hits.from_outside + first);
  }
}

void leave_in_lanes(const Hits& hits, const vec3& to_light, ShadowOrigins<float>& out) {
  const Vector dir = Vector::all(to_light);
  for (int first = 0; first < hits.count; first += kFloats) {
    const Vector side = vector_at(hits.side, first);
    store_flags(dot(side, dir) > Real(0), out.facing + first);
    store_at(surface_floats::leaving_origin(vector_at(hits.point, first), side, Real::load(hits.offset + first), dir),
             out.origin, first);
  }
}

surface_floats::Optics optics_of(const Scene& scene, const Hits& hits, int first) {
  LaneTriples reflect, transmit;
  HWY_ALIGN float ni[16];
  uint8_t bends_light[16], schlick[16], dielectric[16];
  for (int i = 0; i < kFloats; ++i) {
    const Material& m = scene.materials[hits.material[first + i]];
    reflect.set(i, reflect_of(scene, hits, first + i)), transmit.set(i, m.transmit);
    ni[i] = m.ni;
    bends_light[i] = m.bends_light();
    schlick[i] = m.fresnel == Fresnel::schlick, dielectric[i] = m.fresnel == Fresnel::dielectric;
  }
  return {reflect.load(), transmit.load(), Real::load(ni), mask_of(bends_light), mask_of(schlick), mask_of(dielectric)};
}

bool any_scatters(const Scene& scene, const Hits& hits, int first) {
  for (int i = 0; i < kFloats; ++i)
    if (const Material& m = scene.materials[hits.material[first + i]]; m.reflective() || m.transmissive()) return true;
  return false;
}

void scatter_in_lanes(const Scene& scene, const Hits& hits, ScatteredFromHits<float>& out) {
  for (int first = 0; first < hits.count; first += kFloats) {
    if (!any_scatters(scene, hits, first)) continue;
    const Vector point = vector_at(hits.point, first), side = vector_at(hits.side, first);
    const Real offset = Real::load(hits.offset + first);
    const auto rays = surface_floats::scattered_rays(optics_of(scene, hits, first), vector_at(hits.normal, first), side,
                                                     mask_of(hits.from_outside + first), vector_at(hits.dir, first));
    const auto keep = [&](Vector dir, Vector weight, Vector toward, LeavingRays<float>& to) {
      store_at(dir, to.dir, first), store_at(weight, to.weight, first);
      store_at(surface_floats::leaving_origin(point, toward, offset, dir), to.origin, first);
    };
    keep(rays.reflected_dir, rays.reflected_weight, side, out.reflected);
    keep(rays.refracted_dir, rays.refracted_weight, -side, out.refracted);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridrt {
namespace {

template <typename Real, size_t kRoom>
void set(Real (&values)[3][kRoom], int i, const Vec3<Real>& v) {
  for (int k = 0; k < 3; ++k) values[k][i] = v[k];
}

}  // namespace

HWY_EXPORT(find_in_lanes);
HWY_EXPORT(leave_in_lanes);
HWY_EXPORT(scatter_in_lanes);

void find_surfaces(const Scene& scene, HitSurfaces<float>& hits) {
  HRT_CHECK(hits.count <= HitSurfaces<float>::kMost);
  if (hits.count == 0) return;
  const int last = hits.count - 1;
  for (int i = hits.count; i < hits.count + 16; ++i) {  // fills up the last vector
    hits.triangle[i] = hits.triangle[last];
    hits.u[i] = hits.u[last], hits.v[i] = hits.v[last];
    set(hits.dir, i, hits.dir_of(last));
    hits.solid_angle[i] = hits.solid_angle[last], hits.distance[i] = hits.distance[last];
  }
  HWY_DYNAMIC_DISPATCH(find_in_lanes)(scene, hits);
}

void leave_toward(const HitSurfaces<float>& hits, const vec3& to_light, ShadowOrigins<float>& out) {
  HWY_DYNAMIC_DISPATCH(leave_in_lanes)(hits, to_light, out);
}

void scatter_all(const Scene& scene, const HitSurfaces<float>& hits, ScatteredFromHits<float>& out) {
  HWY_DYNAMIC_DISPATCH(scatter_in_lanes)(scene, hits, out);
}

void find_surfaces(const Scene& scene, HitSurfaces<double>& hits) {
  for (int i = 0; i < hits.count; ++i) {
    const Surface<double> surface = surface_at(scene, hits.triangle[i], hits.u[i], hits.v[i], hits.dir_of(i));
    set(hits.point, i, surface.point), set(hits.side, i, surface.side), set(hits.normal, i, surface.normal);
    hits.offset[i] = surface.offset, hits.from_outside[i] = surface.from_outside, hits.material[i] = surface.material;
  }
}

void leave_toward(const HitSurfaces<double>& hits, const dvec3& to_light, ShadowOrigins<double>& out) {
  for (int i = 0; i < hits.count; ++i) {
    const Surface<double> surface = hits.surface(i);
    out.facing[i] = glm::dot(surface.side, to_light) > 0;
    if (out.facing[i]) set(out.origin, i, leave(surface, to_light).origin);
  }
}

void scatter_all(const Scene& scene, const HitSurfaces<double>& hits, ScatteredFromHits<double>& out) {
  for (int i = 0; i < hits.count; ++i) {
    const Material& material = scene.materials[hits.material[i]];
    if (!material.reflective() && !material.transmissive()) continue;
    const Surface<double> surface = hits.surface(i);
    const auto rays = scatter(material, reflect_of(scene, hits, i), surface, hits.dir_of(i));
    const auto keep = [&](const dvec3& dir, const dvec3& weight, bool toward, LeavingRays<double>& to) {
      set(to.dir, i, dir), set(to.weight, i, weight);
      set(to.origin, i, leave(surface, dir, toward).origin);
    };
    keep(rays.reflected_dir, rays.reflected_weight, true, out.reflected);
    keep(rays.refracted_dir, rays.refracted_weight, false, out.refracted);
  }
}

}  // namespace hybridrt
#endif  // HWY_ONCE
