#include "core/render/plan_notes.h"

#include <fmt/format.h>

namespace hybridrt {
namespace {

StepNote left_out(std::string_view step, std::string why) { return {step, Runs::never, std::move(why)}; }

std::string shadows_option(const RenderSettings& s) { return fmt::format("--shadows {}", name_of(s.shadows)); }

std::string pixels(const RenderSettings& s) { return fmt::format("{} x {} pixels", s.width_px, s.height_px); }

/// Empty for one light.
std::string for_each_light(const FramePlan& plan) {
  return plan.lights.size() > 1 ? fmt::format(" for each of {} lights", plan.lights.size()) : std::string();
}

StepNote shadow_map_note(const FramePlan& plan, const RenderSettings& s, bool light_moves) {
  constexpr std::string_view kStep = "pass 1 shadow map";
  if (!plan.shadow_map) return left_out(kStep, shadows_option(s) + " needs none");
  const bool several = plan.lights.size() > 1;
  const bool warped = s.shadow_warp == ShadowWarp::lispsm;
  const char* moving = several ? "kept where a light stands still" : "the light moves";
  const char* still = several ? "the lights stand still" : "the light stands still";
  const char* fitted = several ? "fitted to what is seen; kept while camera and lights stand still"
                               : "fitted to what is seen; kept while camera and light stand still";
  return {kStep, light_moves || warped ? Runs::each_frame : Runs::once,
          fmt::format("{0} x {0} texels{1}; {2}", s.shadow_map_px, for_each_light(plan),
                      warped        ? fitted
                      : light_moves ? moving
                                    : still)};
}

StepNote mark_note(const FramePlan& plan, const RenderSettings& s) {
  constexpr std::string_view kStep = "pass 3 marking";
  if (plan.mark_exact) return {kStep, Runs::each_frame, "where the light buffer's cells cannot answer"};
  if (!plan.mark_blur) return left_out(kStep, shadows_option(s) + " marks none");
  return {kStep, Runs::each_frame, fmt::format("{0} x {0} blur of the shadow test", s.blur_kernel_px)};
}

StepNote readback_note(const FramePlan& plan, const RenderSettings& s) {
  constexpr std::string_view kStep = "readback";
  if (!uses_gl(s)) return left_out(kStep, "all passes run on the CPU");
  if (!plan.read_ids && !plan.read_mask) return left_out(kStep, "nothing on the CPU needs pixels");
  const char* what = !plan.read_mask ? "triangle ids" : plan.read_ids ? "triangle ids and marks" : "marks";
  return {kStep, Runs::each_frame, fmt::format("{} for {}", what, plan.trace() ? "pass 4" : "--aov")};
}

StepNote repair_note(const FramePlan& plan, const RenderSettings& s) {
  constexpr std::string_view kStep = "pass 4 primary hits";
  if (!uses_gl(s)) return left_out(kStep, "the CPU's rasteriser is exact");
  if (!plan.repair) return left_out(kStep, "the raster's triangles are taken as they are");
  return {kStep, Runs::each_frame, "the CPU's exact rasteriser corrects what the GL snapped aside"};
}

StepNote shadow_rays_note(const FramePlan& plan, const RenderSettings& s) {
  constexpr std::string_view kStep = "pass 4 shadow rays";
  if (plan.mark_blur) return {kStep, Runs::each_frame, "at the pixels that pass 3 marks"};
  if (plan.mark_exact) return {kStep, Runs::each_frame, "at the pixels that pass 3 marks"};
  if (s.shadows == ShadowMode::rays)
    return {kStep, Runs::each_frame, "at every pixel that faces the light" + for_each_light(plan)};
  return left_out(kStep, plan.shadow_map ? "the shadow map decides alone" : "--shadows none");
}

StepNote scattered_note(const FramePlan& plan, const SceneFacts& facts, const RenderSettings& s) {
  constexpr std::string_view kStep = "pass 4 reflections";
  if (s.method == Method::raster) return left_out(kStep, "--method raster follows no rays");
  if (facts.scattering_bounds.empty()) return left_out(kStep, "no material reflects or lets light through");
  if (s.reflection_depth == 0) return left_out(kStep, "--reflection-depth 0");
  if (!may_be_seen(plan.view, facts.scattering_bounds))
    return left_out(kStep, "nothing reflective or see-through is in view");
  return {kStep, Runs::each_frame,
          fmt::format("up to {} generations of reflected and refracted rays", s.reflection_depth)};
}

StepNote accelerator_note(const SceneFacts& facts, const RenderSettings& s, bool light_moves) {
  constexpr std::string_view kStep = "ray accelerator";
  if (!needs_caster(facts, s, light_moves)) return left_out(kStep, "no frame can need its rays");
  const std::string_view name = s.method == Method::reference ? "kdtree, double precision" : name_of(s.accel);
  return {kStep, Runs::once, fmt::format("{}, before the first frame", name)};
}

StepNote light_buffer_note(const FramePlan& plan, bool light_moves) {
  constexpr std::string_view kStep = "pass 1 light buffer";
  if (!plan.light_buffers) return left_out(kStep, "no shadow ray asks it");
  return {kStep, light_moves ? Runs::each_frame : Runs::once, "answers all shadow rays" + for_each_light(plan)};
}

}  // namespace

std::string_view name_of(Runs runs) {
  switch (runs) {
    case Runs::never: return "no";
    case Runs::once: return "once";
    case Runs::each_frame: return "each frame";
  }
  return "?";
}

std::vector<StepNote> explain_plan(const FramePlan& plan, const SceneFacts& facts, const RenderSettings& s,
                                   bool light_moves) {
  if (s.method == Method::raytrace || s.method == Method::reference) {
    const std::string method = fmt::format("--method {}", name_of(s.method));
    return {accelerator_note(facts, s, light_moves),
            light_buffer_note(plan, light_moves),
            left_out("other passes 1 to 3", method + " works without GL"),
            {"primary rays", Runs::each_frame, pixels(s)},
            shadow_rays_note(plan, s),
            scattered_note(plan, facts, s),
            s.method == Method::raytrace ? StepNote{"shading", Runs::each_frame, "of what is seen, many pixels at once"}
                                         : left_out("pass 5 shading", "done ray by ray")};
  }
  return {accelerator_note(facts, s, light_moves),
          shadow_map_note(plan, s, light_moves),
          light_buffer_note(plan, light_moves),
          {"pass 2 triangle ids", Runs::each_frame, pixels(s) + (plan.shadow_map ? ", with the shadow test" : "")},
          mark_note(plan, s),
          readback_note(plan, s),
          repair_note(plan, s),
          shadow_rays_note(plan, s),
          scattered_note(plan, facts, s),
          {"pass 5 shading", Runs::each_frame, "once per pixel, from the ids"}};
}

}  // namespace hybridrt
