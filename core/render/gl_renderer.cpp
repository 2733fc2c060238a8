#include "core/render/gl_renderer.h"

#include "core/base/check.h"
#include "core/base/start_thread.h"
#include "core/base/timing.h"
#include "core/passes_cpu/mark_boundary.h"
#include "core/passes_cpu/repair_primary.h"
#include "core/passes_cpu/trace_pass.h"
#include "core/render/aov.h"
#include "core/render/frame_edges.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

const gl::Context& require_size(const gl::Context& context, const RenderSettings& settings) {
  const int limit = context.info().max_texture_px;
  gl::require_limit("a picture width", settings.width_px, "GL_MAX_TEXTURE_SIZE", limit);
  gl::require_limit("a picture height", settings.height_px, "GL_MAX_TEXTURE_SIZE", limit);
  gl::require_limit("a shadow map", settings.shadow_map_px, "GL_MAX_TEXTURE_SIZE", limit);
  return context;
}

/// Sets the reason that --aov marked shows, in every light's mask.
void mark_repaired(FrameSlot& slot) {
  const std::span<const uint32_t> rasterised = slot.rasterised_ids();
  const size_t pixel_count = slot.repaired_ids.size();
  for (size_t first = 0; first < slot.marked_mask.size(); first += pixel_count)
    for (size_t i = 0; i < pixel_count; ++i)
      if (slot.repaired_ids[i] != rasterised[i]) slot.marked_mask[first + i] |= HRT_MASK_REPAIRED;
}

}  // namespace

GlRenderer::GlRenderer(const gl::Context& context, const gl::ShaderSources& shaders, const Scene& scene,
                       const SceneFacts& facts, const Sheets& sheets, const RenderSettings& s, size_t light_count,
                       const RayCaster<float>* caster, ThreadPool& pool)
    : gl_(require_size(context, s).functions()),
      scene_(scene),
      settings_(s),
      caster_(caster),
      pool_(pool),
      facts_(facts),
      light_count_(light_count),
      scene_gpu_(context, scene),
      shadow_map_pass_(gl_, shaders, scene_gpu_.has_holes()),
      id_pass_(gl_, shaders, scene_gpu_.has_holes()),
      shadow_test_pass_(gl_, shaders),
      mark_pass_(gl_, shaders),
      shade_pass_(gl_, shaders, light_count, scene_gpu_.textures.has_value(), scene_gpu_.colors.has_value()),
      part_(rendered_rect(s)),
      depth_(gl_, GL_DEPTH_COMPONENT32F, part_.width_px, part_.height_px, "depth"),
      picture_(gl_, GL_RGBA32F, part_.width_px, part_.height_px, "picture"),
      picture_readback_(gl_, sizeof(vec4) * static_cast<size_t>(part_.width_px) * part_.height_px,
                        "downloading the picture"),
      light_buffers_(scene, sheets, pool) {
  if (repairs_ids(s)) clusters_ = make_clusters(scene, pool);
  HRT_CHECK(light_count <= HRT_MAX_LIGHTS);
  if (uses_shadow_map(s)) {
    for (size_t l = 0; l < light_count; ++l) {
      KeptShadowMap& map = shadow_maps_.emplace_back();
      map.depth = {gl_, GL_DEPTH_COMPONENT32F, s.shadow_map_px, s.shadow_map_px, "shadow map"};
      map.target = {gl_, nullptr, map.depth, "shadow map"};
    }
    if (s.shadow_warp == ShadowWarp::lispsm) receivers_.emplace(gl_, shaders, s);
  }
  if (s.shadows == ShadowMode::blur) {
    unmarked_mask_ = {gl_, GL_R8UI, part_.width_px, part_.height_px, light_count, "unmarked shadow mask"};
    row_sums_ = {gl_, GL_RG8UI, part_.width_px, part_.height_px, "blurred rows"};
  }
  // Edges are traced once the picture is shaded, with the light buffers of its frame.
  const int slots = takes_edge_samples(s) ? 1 : s.frames_in_flight;
  for (int i = 0; i < slots; ++i) slots_.emplace_back(gl_, s, light_count, depth_);
}

GlRenderer::~GlRenderer() {
  for (FrameSlot& slot : slots_)
    if (slot.traced_done.valid()) slot.traced_done.wait();
}

void GlRenderer::render(const NextFrame& next, const DeliverFrame& deliver) {
  const bool interleave = slots_.size() > 1;
  std::deque<FrameSlot*> in_flight;  // oldest first
  std::shared_future<void> previous_trace;
  Stopwatch since_last_frame;

  const auto finish_oldest = [&] {
    Frame frame = shade(*in_flight.front());
    in_flight.pop_front();
    frame.timings.wall_ms = since_last_frame.elapsed_ms();
    since_last_frame.restart();
    deliver(std::move(frame));
  };

  size_t turn = 0;
  while (const std::optional<FrameRequest> request = next()) {
    if (in_flight.size() == slots_.size()) finish_oldest();
    FrameSlot& slot = slots_[turn++ % slots_.size()];
    HRT_CHECK_EQ(request->lights.size(), light_count_);
    slot.begin(make_frame_plan(scene_, facts_, *request, settings_));
    rasterize(slot);
    if (!interleave) {
      trace(slot);
    } else if (slot.plan.trace()) {
      // Traces run one after the other, in the order of the frames.
      slot.traced_done = previous_trace = start_task([this, &slot, previous_trace] {
                                            if (previous_trace.valid()) previous_trace.wait();
                                            trace(slot);
                                          }).share();
    }
    in_flight.push_back(&slot);
  }
  while (!in_flight.empty()) finish_oldest();
}

void GlRenderer::update_shadow_maps(FrameSlot& slot) {
  const FramePlan& plan = slot.plan;
  const auto same_light = [&](size_t l) {
    return shadow_maps_[l].light && shadow_maps_[l].light->toward == plan.lights[l].toward;
  };
  const auto is_kept = [&](size_t l) {
    return !plan.casts_shadow(l) || (same_light(l) && (!receivers_ || shadow_maps_[l].view == at_centres(plan.view)));
  };
  bool drawn = false;
  std::vector<dvec3> seen;
  for (size_t l = 0; l < shadow_maps_.size(); ++l) {
    if (is_kept(l)) continue;
    if (!std::exchange(drawn, true)) {
      slot.timer(PassId::shadow_map).begin();
      if (receivers_) seen = receivers_->find({scene_gpu_, id_pass_, plan.view, plan.near_distance, depth_});
    }
    KeptShadowMap& map = shadow_maps_[l];
    if (!same_light(l)) map.light = fit_light_frame(scene_, plan.lights[l].toward);
    map.view = at_centres(plan.view);
    map.fit = receivers_ ? fit_shadow_map(*map.light, plan.view, seen, settings_.shadow_map_px)
                         : uniform_shadow_map(*map.light, settings_.shadow_map_px);
    shadow_map_pass_.run({scene_gpu_, map.fit, settings_.shadow_map_px}, {map.target});
  }
  if (drawn) slot.timer(PassId::shadow_map).end();
}

void GlRenderer::test_shadows(FrameSlot& slot) {
  const FramePlan& plan = slot.plan;
  for (size_t l = 0; l < shadow_maps_.size(); ++l)
    if (plan.casts_shadow(l))
      shadow_test_pass_.run(
          {scene_gpu_, plan.view, plan.lights[l].toward, shadow_maps_[l].fit, slot.ids, shadow_maps_[l].depth},
          {plan.mark_blur ? unmarked_mask_ : slot.mask, static_cast<int>(l)});
}

void GlRenderer::mark_boundaries(FrameSlot& slot) {
  const FramePlan& plan = slot.plan;
  slot.timer(PassId::mark).begin();
  for (size_t l = 0; l < shadow_maps_.size(); ++l)
    if (plan.casts_shadow(l))
      mark_pass_.run(
          {unmarked_mask_, plan.view.width_px, plan.view.height_px, settings_.blur_kernel_px, static_cast<int>(l)},
          {row_sums_, slot.mask});
  slot.timer(PassId::mark).end();
}

void GlRenderer::rasterize(FrameSlot& slot) {
  const FramePlan& plan = slot.plan;
  slot.timer(PassId::id).begin();
  id_pass_.run({scene_gpu_, plan.view, plan.near_distance}, {slot.id_target});
  if (plan.shadow_map) {
    update_shadow_maps(slot);
    test_shadows(slot);
  }
  slot.timer(PassId::id).end();
  if (plan.mark_blur) mark_boundaries(slot);

  if (!plan.read_ids && !plan.read_mask) return;
  slot.timer(PassId::readback).begin();
  if (plan.read_ids) slot.ids_readback.start(slot.ids, GL_RED_INTEGER, GL_UNSIGNED_INT);
  if (plan.read_mask) slot.mask_readback.start(slot.mask, GL_RED_INTEGER, GL_UNSIGNED_BYTE);
  slot.timer(PassId::readback).end();
  gl_.Flush();  // else the driver may record the end only after pass 4
  if (plan.read_ids) slot.ids_readback.wait();
  if (plan.read_mask) slot.mask_readback.wait();
}

void GlRenderer::trace(FrameSlot& slot) {
  const FramePlan& plan = slot.plan;
  if (!plan.trace()) return;
  HRT_CHECK(caster_ || !(plan.trace_scattered || (plan.trace_shadows && !plan.light_buffers)));
  CpuResults& cpu = slot.cpu;
  const Stopwatch stopwatch;
  RepairStats repair;
  double repair_ms = 0;
  if (plan.repair) {
    repair = repair_primary_hits(scene_, clusters_, plan.view, pool_, raster_memory_, slot.rasterised_ids(),
                                 slot.repaired_ids);
    repair_ms = stopwatch.elapsed_ms();
  }
  TraceJob job = make_trace_job(scene_, plan, settings_);
  if (plan.light_buffers) cpu.light_buffer_ms = light_buffers_.answer(job);
  if (plan.mark_exact) {
    const Stopwatch marking;
    mark_boundary(job, pool_, slot.seen_ids(), slot.marked_mask, slot.lit_pixels, slot.marked);
    if (settings_.aovs & kAovMarked) mark_repaired(slot);
    cpu.mark_ms = marking.elapsed_ms();
    cpu.stats = answer_marked(job, pool_, slot.marked, slot.lit_pixels);
  }
  TracePixels pixels{slot.seen_ids(), slot.read_mask(), {}, {}};
  if (plan.trace_shadows && !plan.mark_exact) pixels.lit = slot.lit_pixels;
  if (plan.trace_scattered) pixels.traced = slot.traced_pixels;
  if (!pixels.lit.empty() || !pixels.traced.empty()) cpu.stats.add(trace_pass(job, caster_, pool_, pixels));
  cpu.stats.pixels_suspect = repair.checked;
  cpu.stats.pixels_repaired = repair.repaired;
  cpu.stats.repair_ms = repair_ms;
  cpu.trace_ms = stopwatch.elapsed_ms() - cpu.light_buffer_ms - cpu.mark_ms;
}

double GlRenderer::upload(FrameSlot& slot) {
  const FramePlan& plan = slot.plan;
  if (!plan.trace()) return 0;
  const int width = plan.view.width_px, height = plan.view.height_px;
  const Stopwatch copying;  // the driver copies on this thread first
  slot.timer(PassId::upload).begin();
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (slot.cpu.stats.pixels_repaired > 0)
    gl_.TextureSubImage2D(slot.ids.id(), 0, 0, 0, width, height, GL_RED_INTEGER, GL_UNSIGNED_INT,
                          slot.repaired_ids.data());
  if (plan.trace_shadows)
    gl_.TextureSubImage3D(slot.lit.id(), 0, 0, 0, 0, width, height, static_cast<GLsizei>(plan.lights.size()),
                          GL_RED_INTEGER, GL_UNSIGNED_BYTE, slot.lit_pixels.data());
  if (plan.trace_scattered)
    gl_.TextureSubImage2D(slot.traced.id(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, slot.traced_pixels.data());
  slot.timer(PassId::upload).end();
  return copying.elapsed_ms();
}

Frame GlRenderer::shade(FrameSlot& slot) {
  const FramePlan& plan = slot.plan;
  if (slot.traced_done.valid()) std::exchange(slot.traced_done, {}).get();
  const double copying_ms = upload(slot);

  slot.timer(PassId::shade).begin();
  const gl::TextureArray* mask = plan.trace_shadows ? &slot.lit : plan.shadow_map ? &slot.mask : nullptr;
  shade_pass_.run({scene_gpu_, plan.view, slot.ids, mask, plan.trace_scattered ? &slot.traced : nullptr, plan.lights,
                   settings_.ambient, settings_.background},
                  {picture_});
  slot.timer(PassId::shade).end();

  slot.timer(PassId::download).begin();
  picture_readback_.start(picture_, GL_RGBA, GL_FLOAT);
  slot.timer(PassId::download).end();
  gl_.Flush();
  picture_readback_.wait();

  Frame frame = make_frame(slot);
  frame.timings[PassId::upload] += copying_ms;
  if (takes_edge_samples(settings_)) {
    TraceJob job = make_trace_job(scene_, plan, settings_);
    if (plan.light_buffers) light_buffers_.answer(job);
    sample_frame_edges(plan, job, settings_,
                       {*caster_, repairs_ids(settings_) ? &clusters_ : nullptr, raster_memory_, edge_memory_}, pool_,
                       frame);
  }
  return frame;
}

Frame GlRenderer::make_frame(FrameSlot& slot) const {
  const FramePlan& plan = slot.plan;
  const PixelRect kept = kept_of_rendered(settings_);
  Frame frame;
  frame.number = plan.number;
  frame.stats = slot.cpu.stats;
  const Stopwatch unpacking;
  frame.picture = picture_from_rgba(static_cast<const vec4*>(picture_readback_.data()), plan.view.width_px,
                                    plan.view.height_px, kept, settings_.alpha, frame.stats);
  const double unpacking_ms = unpacking.elapsed_ms();
  for (size_t pass = 0; pass < slot.timers.size(); ++pass) frame.timings.pass_ms[pass] = slot.timers[pass].elapsed_ms();
  frame.timings[PassId::id] -= frame.timings[PassId::shadow_map];  // which runs between ids and shadow test
  frame.timings[PassId::trace] = slot.cpu.trace_ms;
  frame.timings[PassId::shadow_map] += slot.cpu.light_buffer_ms;  // pass 1's other structure
  frame.timings[PassId::mark] += slot.cpu.mark_ms;
  frame.timings[PassId::download] += unpacking_ms;

  AovSource source{plan.lights, slot.seen_ids(), slot.read_mask(), {}, {}};
  if (plan.trace_shadows) source.lit = slot.lit_pixels;
  if (plan.trace_scattered) source.traced = slot.traced_pixels;
  frame.aovs = make_aovs(scene_, plan.view, kept, source, settings_.aovs);
  return frame;
}

}  // namespace hybridrt
