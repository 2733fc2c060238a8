#include "core/render/frame_slot.h"

namespace hybridrt {
namespace {

int width(const RenderSettings& s) { return rendered_rect(s).width_px; }
int height(const RenderSettings& s) { return rendered_rect(s).height_px; }
size_t pixel_count(const RenderSettings& s) { return static_cast<size_t>(width(s)) * height(s); }

}  // namespace

FrameSlot::FrameSlot(const gl::Functions& gl, const RenderSettings& s, size_t light_count, const gl::Texture& depth)
    : ids(gl, GL_R32UI, width(s), height(s), "ids"),
      mask(gl, GL_R8UI, width(s), height(s), light_count, "shadow mask"),
      lit(gl, GL_R8UI, width(s), height(s), light_count, "lit"),
      traced(gl, GL_RGBA32F, width(s), height(s), "traced"),
      id_target(gl, &ids, depth, "ids"),
      ids_readback(gl, pixel_count(s) * sizeof(uint32_t), "reading back ids"),
      mask_readback(gl, light_count * pixel_count(s), "reading back the shadow mask"),
      repaired_ids(s.shadows == ShadowMode::exact || s.shadows == ShadowMode::rays ? pixel_count(s) : 0),
      marked_mask(s.shadows == ShadowMode::exact ? light_count * pixel_count(s) : 0),
      lit_pixels(light_count * pixel_count(s)),
      traced_pixels(pixel_count(s)) {
  for (size_t i = 0; i < static_cast<size_t>(PassId::count); ++i) timers.emplace_back(gl);
}

void FrameSlot::begin(FramePlan next) {
  plan = std::move(next);
  cpu = {};
  for (gl::TimerQuery& timer : timers) timer.skip();
}

std::span<const uint32_t> FrameSlot::rasterised_ids() const {
  if (!plan.read_ids) return {};
  return {static_cast<const uint32_t*>(ids_readback.data()), traced_pixels.size()};
}

std::span<const uint32_t> FrameSlot::seen_ids() const { return plan.repair ? repaired_ids : rasterised_ids(); }

std::span<const uint8_t> FrameSlot::read_mask() const {
  if (plan.mark_exact) return marked_mask;
  if (!plan.read_mask) return {};
  return {static_cast<const uint8_t*>(mask_readback.data()), lit_pixels.size()};
}

}  // namespace hybridrt
