#include "core/passes_cpu/shade.h"

#include "core/base/check.h"
#include "core/trace/surface_at.h"
#include "core/trace/texture_lookup.h"

// clang-format off: the order matters
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/passes_cpu/shade.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

#include "core/trace/surface_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

using Real = LaneReal<float>;
using Vector = LaneVec3<float>;
constexpr int kFloatsAtOnce = lane_count<float>();

/// What the materials of a vector of points say.
struct LanePaint {
  Vector kd, ks, ke;
  Real ns, opacity;
};

class LaneShader {
 public:
  LaneShader(const TraceJob& job, const View& view, const SeenPoints& points, const uint8_t* lit)
      : job_(job), scene_(job.scene), view_(view), points_(points), lit_(lit) {}

  Vector color(int first) const {
    const Vector dir = vector_at(points_.dir, first), side = vector_at(points_.side, first);
    const Vector normal =
        surface_floats::turned_toward(surface_floats::normalized_or(interpolated_normal(first), side), side);
    const LanePaint paint = paint_at(first);
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
  static Vector vector_at(const float (&values)[3][SeenPoints::kRoom], int first) {
    return {Real::load(values[0] + first), Real::load(values[1] + first), Real::load(values[2] + first)};
  }

  Vector interpolated_normal(int first) const {
    HWY_ALIGN float corner[3][3][16];
    for (int i = 0; i < kFloatsAtOnce; ++i) {
      const uvec3& numbers = scene_.triangle_normals[points_.triangle[first + i]];
      for (int k = 0; k < 3; ++k) {
        const vec3& n = scene_.normals[numbers[k]];
        corner[k][0][i] = n.x, corner[k][1][i] = n.y, corner[k][2][i] = n.z;
      }
    }
    const auto at = [&](int k) {
      return Vector(Real::load(corner[k][0]), Real::load(corner[k][1]), Real::load(corner[k][2]));
    };
    const Real u = Real::load(points_.u + first), v = Real::load(points_.v + first);
    return (Real(1) - u - v) * at(0) + u * at(1) + v * at(2);
  }

  LanePaint paint_at(int first) const {
    const uint32_t material = scene_.triangle_materials[points_.triangle[first]];
    bool alike = !scene_.has_colors() && scene_.materials[material].texture_maps == 0;
    for (int i = 1; i < kFloatsAtOnce && alike; ++i)
      alike = scene_.triangle_materials[points_.triangle[first + i]] == material;
    if (!alike) return paint_of_each(first);
    const Material& m = scene_.materials[material];
    return {Vector::all(m.kd), Vector::all(m.ks), Vector::all(m.ke), Real(m.ns), Real(m.opacity)};
  }

  LanePaint paint_of_each(int first) const {
    HWY_ALIGN float kd[3][16], ks[3][16], ke[3][16], ns[16], opacity[16];
    for (int i = 0; i < kFloatsAtOnce; ++i) {
      const Material& m = scene_.material_of(points_.triangle[first + i]);
      const SurfaceColors<float> colors = colors_of(m, first + i);
      for (int k = 0; k < 3; ++k) kd[k][i] = colors.kd[k], ks[k][i] = colors.ks[k], ke[k][i] = colors.ke[k];
      ns[i] = m.ns, opacity[i] = m.opacity;
    }
    const auto at = [](const float(&v)[3][16]) { return Vector(Real::load(v[0]), Real::load(v[1]), Real::load(v[2])); };
    return {at(kd), at(ks), at(ke), Real::load(ns), Real::load(opacity)};
  }

  SurfaceColors<float> colors_of(const Material& m, int i) const {
    const uint32_t triangle = points_.triangle[i];
    if (m.texture_maps == 0) return plain_colors(scene_, triangle, points_.u[i], points_.v[i]);
    const dvec3 origin(points_.origin[0][i], points_.origin[1][i], points_.origin[2][i]);
    return textured_colors(scene_, triangle, points_.u[i], points_.v[i],
                           vec3(points_.dir[0][i], points_.dir[1][i], points_.dir[2][i]),
                           static_cast<float>(view_.sample_solid_angle(points_.x[i], points_.y[i])),
                           static_cast<float>(glm::distance(view_.eye, origin)));
  }

  const TraceJob& job_;
  const Scene& scene_;
  const View& view_;
  const SeenPoints& points_;
  const uint8_t* const lit_;
};

void shade_in_lanes(const TraceJob& job, const View& view, const SeenPoints& points, const uint8_t* lit,
                    float (&colors)[3][SeenPoints::kRoom]) {
  const LaneShader shader(job, view, points, lit);
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

void shade(const TraceJob& job, const View& view, const SeenPoints& points, std::span<const uint8_t> lit,
           float (&colors)[3][SeenPoints::kRoom]) {
  HRT_CHECK(lit.size() >= static_cast<size_t>(points.count));
  HWY_DYNAMIC_DISPATCH(shade_in_lanes)(job, view, points, lit.data(), colors);
}

}  // namespace hybridrt
#endif  // HWY_ONCE
