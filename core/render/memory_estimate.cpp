#include "core/render/memory_estimate.h"

#include <algorithm>
#include <bit>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/raster/map_triangle.h"
#include "core/render/edge_samples.h"
#include "core/trace/light_buffer.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

// Measured on balls, chess and grass, of 500,000 to five million triangles (tests/bench/memory_bench): 73 to 82 and 60
// to 62.
constexpr size_t kEmbreeBytesPerTriangle = 90, kKdTreeBytesPerTriangle = 75;
constexpr size_t kClusterBytesPerTriangle = 34;       // of the CPU's rasteriser; measured: 22 to 32
constexpr size_t kLightBufferBytesPerTriangle = 155;  // measured: 67 (balls) to 152 (grass)
constexpr size_t kBuildingBytesPerTriangle =
    110;                                     // beside a light buffer that is made, edges not yet given back included
constexpr size_t kMapBytesPerTriangle = 40;  // drawing shadow maps on the CPU: tiles' lists

size_t geometry_bytes(const Scene& scene) {
  return bytes_of(scene.positions) + bytes_of(scene.normals) + bytes_of(scene.triangle_positions) +
         bytes_of(scene.triangle_normals) + bytes_of(scene.triangle_materials) + bytes_of(scene.colors) +
         bytes_of(scene.triangle_colors) + (scene.textures ? scene.textures->memory_bytes() : 0);
}

size_t rendered_pixels(const RenderSettings& s) {
  const PixelRect part = rendered_rect(s);
  return static_cast<size_t>(part.width_px) * part.height_px;
}

size_t shadow_map_bytes(const RenderSettings& s, size_t lights) {
  return lights * sizeof(float) * s.shadow_map_px * s.shadow_map_px;
}

/// The sizes follow the formats in GlRenderer and FrameSlot.
size_t gpu_frame_bytes(const RenderSettings& s, size_t lights) {
  const size_t pixels = rendered_pixels(s);
  const size_t depth = 4, picture = 16 + 16;          // and its readback
  const size_t slot = 4 * 2 + lights * (2 + 1) + 16;  // ids and mask with their readbacks, lit, traced
  size_t bytes = pixels * (depth + picture + s.frames_in_flight * slot);
  if (uses_shadow_map(s)) {
    bytes += shadow_map_bytes(s, lights);
    if (s.shadow_warp == ShadowWarp::lispsm && renders_part(s)) bytes += depth * s.width_px * s.height_px;
  }
  if (s.shadows == ShadowMode::blur) bytes += pixels * (lights + 2);  // the unmarked mask and row sums
  return bytes;
}

/// What passes 3 and 4 write in each slot, or the whole frame of render_reference, render_tiles or render_mapped.
size_t cpu_frame_bytes(const RenderSettings& s, size_t lights) {
  const size_t lit = lights, traced = 16, ids = 4;
  if (!uses_gl(s)) {
    size_t bytes = rendered_pixels(s) * (traced + ids + lit);
    if (!uses_shadow_map(s)) return bytes;
    bytes += rendered_pixels(s) * (lights + 2);  // the mask and the blur's sums
    if (s.shadow_warp == ShadowWarp::lispsm && renders_part(s)) bytes += ids * s.width_px * s.height_px;
    return bytes + shadow_map_bytes(s, lights);
  }
  size_t slot = lit + traced;
  if (s.shadows == ShadowMode::exact || s.shadows == ShadowMode::rays) slot += ids;  // repaired
  constexpr size_t kMarked = sizeof(ShadowQuery) / 4;  // queries left to pass 4: one pixel in four
  if (s.shadows == ShadowMode::exact) slot += lights * (1 + kMarked);
  return rendered_pixels(s) * s.frames_in_flight * slot;
}

/// EdgeMemory and what sample_edges() gathers, if all pixels are near edges.
size_t edge_sample_bytes(const RenderSettings& s) {
  constexpr size_t kPerPixel = 1 + 2 * sizeof(PixelAt) + 2 * sizeof(vec4);
  return takes_edge_samples(s) ? kPerPixel * rendered_pixels(s) : 0;
}

/// With its AOVs: at most as many floats each.
size_t picture_bytes(const RenderSettings& s) {
  const PixelRect rect = picture_rect(s);
  const size_t layers = 1 + static_cast<size_t>(std::popcount(s.aovs));
  return layers * (s.alpha ? 16 : 12) * static_cast<size_t>(rect.width_px) * rect.height_px;
}

}  // namespace

uint64_t most_written_bytes(const RenderSettings& s, int threads) {
  constexpr uint64_t kSlackBytes = uint64_t{64} << 20, kMostPictures = 64;
  const uint64_t picture = picture_bytes(s);
  const uint64_t slack = std::min(kSlackBytes / picture, kMostPictures);
  return picture * std::max<uint64_t>(slack, static_cast<uint64_t>(threads) + 2);
}

MemoryEstimate estimate_frame_memory(const RenderSettings& s, size_t light_count, int threads, int64_t frame_count) {
  MemoryEstimate estimate;
  if (uses_gl(s)) estimate.gpu_frames = gpu_frame_bytes(s, light_count);
  estimate.frames = cpu_frame_bytes(s, light_count) + edge_sample_bytes(s);
  const uint64_t picture = picture_bytes(s), written = most_written_bytes(s, threads) / picture;
  estimate.pictures = picture * std::min<uint64_t>(frame_count, 1 + written);  // the current one, and those
  return estimate;
}

MemoryEstimate estimate_memory(const Scene& scene, const SceneFacts& facts, const Topology& topology,
                               const Sheets& sheets, const RenderSettings& s, size_t light_count, bool light_moves,
                               int threads, int64_t frame_count) {
  MemoryEstimate estimate = estimate_frame_memory(s, light_count, threads, frame_count);
  estimate.topology = memory_bytes(topology) + memory_bytes(sheets);
  estimate.scene = geometry_bytes(scene) + bytes_of(scene.materials);
  if (uses_gl(s))
    estimate.gpu_scene = geometry_bytes(scene) + scene.materials.size() * HRT_MATERIAL_TEXELS * sizeof(vec4);
  const bool kd_tree = s.accel == Accel::kdtree || s.method == Method::reference;
  const bool on_cpu = s.forms == PassForms::cpu && (s.method == Method::hybrid || s.method == Method::raster);
  if (on_cpu || repairs_ids(s)) estimate.accelerator = scene.triangle_count() * kClusterBytesPerTriangle;
  if (on_cpu && uses_shadow_map(s))
    estimate.accelerator += scene.positions.size() * sizeof(MapCorner) + scene.triangle_count() * kMapBytesPerTriangle;
  if (needs_caster(facts, s, light_moves))
    estimate.accelerator += scene.triangle_count() * (kd_tree ? kKdTreeBytesPerTriangle : kEmbreeBytesPerTriangle);
  const bool scatters = s.reflection_depth > 0 && !facts.scattering_bounds.empty();
  const bool asks_light = s.method == Method::raytrace || s.shadows == ShadowMode::blur ||
                          s.shadows == ShadowMode::exact || s.shadows == ShadowMode::rays || scatters;
  if (s.method != Method::reference && s.method != Method::raster && s.shadows != ShadowMode::none && asks_light)
    estimate.accelerator += scene.triangle_count() * (light_count * kLightBufferBytesPerTriangle +
                                                      (light_count > 0 ? kBuildingBytesPerTriangle : 0));
  return estimate;
}

void require_room_for_frames(const RenderSettings& s, size_t light_count, int threads, int64_t frame_count,
                             uint64_t sheet_bytes, uint64_t most_bytes) {
  const uint64_t bytes = estimate_frame_memory(s, light_count, threads, frame_count).total() + sheet_bytes;
  if (bytes > most_bytes)
    throw error(
        ErrorKind::usage,
        "frames of {}x{} pixels need about {} of memory, but {} are allowed; render smaller ones (--size, --crop, "
        "--shadow-map), use fewer --frames-in-flight, --threads or lights, or raise --max-memory",
        s.width_px, s.height_px, size_text(bytes), size_text(most_bytes));
}

}  // namespace hybridrt
