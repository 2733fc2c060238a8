#include "core/simplify/view_bounds.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/mesh/triangle_distance.h"

namespace hybridrt {
namespace {

constexpr size_t kGrain = 1024;

struct Corners {
  dvec3 a, b, c;  ///< relative to the eye
};

double distance_from_eye(const Corners& t) { return std::sqrt(squared_distance_to_triangle(dvec3(0), t.a, t.b, t.c)); }

/// How near to the eye the triangle's shadow may fall, if it is not infinitely thin.
double shadow_distance(const Corners& t, const dvec3& toward_light) {
  const dvec3& l = toward_light;
  const double a = glm::dot(t.a, l), b = glm::dot(t.b, l), c = glm::dot(t.c, l);
  if (a <= 0 && b <= 0 && c <= 0) return distance_from_eye(t);  // it falls away from the eye
  return distance_from_eye({t.a - a * l, t.b - b * l, t.c - c * l});
}

/// A view's constants.
struct Pixels {
  const Sight& sight;
  double share;              ///< the bound as a share of the distance, in the middle of the view
  double corner_cosine;      ///< of the angle between the middle and the corners, squared
  double distance_of_scene;  ///< of the eye from the scene's box

  Pixels(const Sight& of, const Aabb& scene, double max_error_px) : sight(of) {
    const View& view = of.view;
    share = max_error_px *
            std::min(2 * view.tan_half_width / view.frame_width_px, 2 * view.tan_half_height / view.frame_height_px);
    share /= 1 + share;  // what has moved may be nearer by as much
    corner_cosine = 1 / (1 + view.tan_half_width * view.tan_half_width + view.tan_half_height * view.tan_half_height);
    distance_of_scene = glm::length(view.eye - glm::clamp(view.eye, dvec3(scene.lo), dvec3(scene.hi)));
  }

  /// The square of the cosine of the angle from the middle of the view; that of the corners outside.
  double cosine(const dvec3& p) const {
    const double along = glm::dot(p, sight.view.forward);
    return along > 0 ? std::max(along * along / glm::dot(p, p), corner_cosine) : corner_cosine;
  }

  double bound(const Corners& t) const {
    // The angle is largest at a corner: what is within an angle is a convex cone.
    double reach = distance_from_eye(t) * std::min({cosine(t.a), cosine(t.b), cosine(t.c)});
    for (const dvec3& toward_light : sight.toward_lights)
      reach = std::min(reach, std::max(shadow_distance(t, toward_light), distance_of_scene) * corner_cosine);
    return share * reach;
  }
};

}  // namespace

void narrow_bounds(const Scene& scene, std::span<const Sight> sights, double max_error_px, std::vector<float>& bounds,
                   ThreadPool& pool) {
  HRT_CHECK_EQ(bounds.size(), scene.triangle_count());
  std::vector<Pixels> frames;
  for (const Sight& sight : sights) frames.emplace_back(sight, scene.bounds, max_error_px);
  parallel_for(pool, bounds.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t t = begin; t < end; ++t) {
      const auto corner = [&](int k) { return dvec3(scene.vertex(static_cast<uint32_t>(t), k)); };
      for (const Pixels& frame : frames) {
        const dvec3& eye = frame.sight.view.eye;
        const double bound = frame.bound({corner(0) - eye, corner(1) - eye, corner(2) - eye});
        bounds[t] = std::min(bounds[t], static_cast<float>(bound));
      }
    }
  });
}

void keep_mirrors(const Scene& scene, std::vector<float>& bounds) {
  HRT_CHECK_EQ(bounds.size(), scene.triangle_count());
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    if (const Material& material = scene.material_of(t); material.reflective() || material.bends_light()) bounds[t] = 0;
}

}  // namespace hybridrt
