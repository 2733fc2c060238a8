#include "core/render/memory_estimate.h"

#include "core/render/gl_renderer.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

// Measured on balls, a cathedral, a car and a scan of 75,000 to a million triangles: 77 to 115 and 58 to 62.
constexpr size_t kEmbreeBytesATriangle = 90, kKdTreeBytesATriangle = 62;
constexpr size_t kLightBufferBytesATriangle = 130;

template <typename T>
size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

size_t geometry_bytes(const Scene& scene) {
  return bytes_of(scene.positions) + bytes_of(scene.normals) + bytes_of(scene.triangle_positions) +
         bytes_of(scene.triangle_normals) + bytes_of(scene.triangle_materials);
}

/// The formats are those of GlRenderer and FrameSlot.
size_t frame_bytes(const RenderSettings& s) {
  const size_t pixels = static_cast<size_t>(s.width_px) * s.height_px;
  const size_t depth = 4, picture = 16 + 16;  // and its readback
  const size_t slot = (4 + 1) * 2 + 1 + 16;   // ids and mask with their readbacks, lit, traced
  size_t bytes = pixels * (depth + picture + s.frames_in_flight * slot);
  if (s.shadows == ShadowMode::map || s.shadows == ShadowMode::blur)
    bytes += size_t{4} * s.shadow_map_px * s.shadow_map_px;
  if (s.shadows == ShadowMode::blur) bytes += pixels * (1 + 2);  // the unmarked mask and row sums
  return bytes;
}

}  // namespace

MemoryEstimate estimate_memory(const Scene& scene, const SceneFacts& facts, const RenderSettings& s,
                               Accel accel, bool light_moves) {
  MemoryEstimate estimate;
  estimate.scene = geometry_bytes(scene) + bytes_of(scene.materials);
  if (s.method == Method::hybrid || s.method == Method::raster) {
    estimate.gpu_scene = geometry_bytes(scene) + scene.materials.size() * HRT_MATERIAL_TEXELS * sizeof(vec4);
    estimate.gpu_frames = frame_bytes(s);
  }
  const bool kd_tree = accel == Accel::kdtree || s.method == Method::reference;
  if (needs_caster(facts, s, light_moves))
    estimate.accelerator = scene.triangle_count() * (kd_tree ? kKdTreeBytesATriangle : kEmbreeBytesATriangle);
  const bool scatters = s.reflection_depth > 0 && !facts.scattering_bounds.empty();
  const bool asks_light = s.method == Method::raytrace || s.shadows == ShadowMode::blur ||
                          s.shadows == ShadowMode::rays || scatters;
  if (s.method != Method::reference && s.method != Method::raster && s.shadows != ShadowMode::none && asks_light)
    estimate.accelerator += scene.triangle_count() * kLightBufferBytesATriangle;
  return estimate;
}

}  // namespace hybridrt
