#include "core/render/frame_plan.h"

#include <algorithm>

namespace hybridrt {
namespace {

// The near plane, as a share of the scene: far below what positions resolve, so that nothing in view is cut away.
// Reversed depth loses nothing by it.
constexpr double kNearest = 1e-12;

}  // namespace

SceneFacts make_scene_facts(const Scene& scene) {
  SceneFacts facts;
  facts.bounds = scene.bounds;
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    const Material& material = scene.material_of(i);
    if (!material.reflective() && !material.transmissive()) continue;
    for (int corner = 0; corner < 3; ++corner) facts.scattering_bounds.grow(scene.vertex(i, corner));
  }
  return facts;
}

bool repairs_ids(const RenderSettings& s) {
  return s.method == Method::hybrid && uses_gl(s) && (s.shadows == ShadowMode::exact || s.shadows == ShadowMode::rays);
}

bool needs_caster(const SceneFacts& facts, const RenderSettings& s, bool light_moves) {
  if (takes_edge_samples(s)) return true;
  if (s.method != Method::hybrid) return s.method != Method::raster;
  const bool scatters = s.reflection_depth > 0 && !facts.scattering_bounds.empty();
  return (s.shadows == ShadowMode::blur && light_moves) || scatters;
}

bool may_be_seen(const View& view, const Aabb& box) {
  if (box.empty()) return false;
  // Inward normals of the four side planes through the eye, and the plane of the eye itself.
  const dvec3 planes[] = {view.forward, view.tan_half_width * view.forward + view.right,
                          view.tan_half_width * view.forward - view.right,
                          view.tan_half_height * view.forward + view.up, view.tan_half_height * view.forward - view.up};
  for (const dvec3& plane : planes) {
    const dvec3 farthest(plane.x > 0 ? box.hi.x : box.lo.x, plane.y > 0 ? box.hi.y : box.lo.y,
                         plane.z > 0 ? box.hi.z : box.lo.z);
    if (glm::dot(plane, farthest - view.eye) < 0) return false;
  }
  return true;
}

FramePlan make_frame_plan(const Scene& scene, const SceneFacts& facts, const FrameRequest& request,
                          const RenderSettings& settings) {
  FramePlan plan;
  plan.number = request.number;
  const PixelRect part = rendered_rect(settings);
  plan.view = part_of(make_view(request.camera, scene.origin_world, settings.width_px, settings.height_px), part.x_px,
                      part.y_px, part.width_px, part.height_px);
  plan.view.sample_px = request.sample_offset_px;
  plan.view.samples = takes_edge_samples(settings) ? 1 : settings.samples;
  plan.lights = request.lights;
  const double size = glm::length(dvec3(facts.bounds.extent()));
  plan.near_distance = kNearest * std::max(size, 1e-30);

  const bool hybrid = settings.method == Method::hybrid, raytrace = settings.method == Method::raytrace;
  const ShadowMode shadows = count_shadow_casters(plan.lights) > 0 ? settings.shadows : ShadowMode::none;
  plan.shadows = shadows != ShadowMode::none;
  plan.shadow_map = shadows == ShadowMode::map || shadows == ShadowMode::blur;
  plan.mark_blur = shadows == ShadowMode::blur;
  plan.mark_exact = hybrid && shadows == ShadowMode::exact;
  plan.trace_shadows = (hybrid || raytrace) && (plan.mark_blur || plan.mark_exact || shadows == ShadowMode::rays);
  // The exact modes also repair which triangle is seen, whatever the light.
  plan.repair = repairs_ids(settings);
  plan.trace_scattered =
      (hybrid || raytrace) && settings.reflection_depth > 0 && may_be_seen(plan.view, facts.scattering_bounds);

  // Light buffers are worth building for a few rays only if the next frames can use them too.
  const bool asks_light = plan.trace() || raytrace;
  plan.light_buffers =
      plan.shadows && asks_light && (plan.mark_exact || shadows == ShadowMode::rays || !request.light_moves);

  const uint32_t from_ids = kAovId | kAovDepth | kAovNormal;
  plan.read_ids = plan.trace() || (settings.aovs & from_ids);
  plan.read_mask = plan.mark_blur || (plan.shadow_map && (settings.aovs & (kAovShadow | kAovMarked)));
  return plan;
}

}  // namespace hybridrt
