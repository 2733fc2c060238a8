#include "cli/render_options.h"

#include "cli/camera_options.h"
#include "cli/light_options.h"
#include "cli/option_values.h"
#include "core/image_io/read_image.h"
#include "core/load/loading_bytes.h"
#include "core/load/scene_file.h"
#include "core/load/scene_source.h"
#include "core/procedural/procedural.h"
#include "core/render/memory_estimate.h"

namespace hybridrt::cli {
namespace {

const std::map<std::string, ShadowMode> kShadows = {{"none", ShadowMode::none},
                                                    {"map", ShadowMode::map},
                                                    {"blur", ShadowMode::blur},
                                                    {"exact", ShadowMode::exact},
                                                    {"rays", ShadowMode::rays}};

std::optional<UpAxis> parse_up_axis(const RenderOptions& o) {
  if (o.up_axis.empty()) return std::nullopt;
  if (o.up_axis != "y" && o.up_axis != "z")
    throw error(ErrorKind::usage, "--up-axis {}: not known; one of y, z", o.up_axis);
  return o.up_axis == "y" ? UpAxis::y : UpAxis::z;
}

FrameRange make_sequence(const RenderOptions& o, const FrameSpec& frames) {
  if (o.sequence.empty()) return {frames.lowest(), frames.highest(), 1};
  const FrameRange sequence = parse_sequence(o.sequence);
  if (frames.lowest() < sequence.first || frames.highest() > sequence.last)
    throw error(ErrorKind::usage, "--frames {} is not a part of --sequence {}", o.frames, o.sequence);
  return sequence;
}

}  // namespace

RenderSettings make_settings(const RenderOptions& o) {
  RenderSettings s;
  parse_size(o.size, s);
  if (!o.crop.empty()) parse_crop(o.crop, s);
  s.method = o.method;
  s.shadows = default_shadows(o.method);
  if (!o.shadows.empty()) by_name("--shadows", kShadows, s.shadows)(o.shadows);
  require_method_takes(s.method, s.shadows);
  require_range("--blur-kernel", o.blur_kernel, 1, 31);
  if (o.blur_kernel % 2 == 0) throw error(ErrorKind::usage, "--blur-kernel {}: it must be odd, 1 to 31", o.blur_kernel);
  require_range("--shadow-map", o.shadow_map, 1, kLargestSide_px);
  require_range("--reflection-depth", o.reflection_depth, 0, 64);
  require_range("--samples", o.samples, 1, 4096);
  require_range("--frames-in-flight", o.frames_in_flight, 1, 16);
  s.blur_kernel_px = o.blur_kernel;
  s.shadow_map_px = o.shadow_map;
  s.shadow_warp = o.shadow_warp;
  s.reflection_depth = o.reflection_depth;
  s.samples = o.samples;
  s.frames_in_flight = o.frames_in_flight;
  s.aovs = parse_aovs(o.aovs);
  return s;
}

int thread_count(const RenderOptions& o) {
  if (o.threads) require_range("--threads", *o.threads, 1, 1024);
  return o.threads.value_or(allowed_processors());
}

RenderJob make_render_job(const RenderOptions& command_line, Warnings& warnings, LoadProgress* progress) {
  const RenderOptions o = with_scene_settings(command_line);
  const SceneDescription scene = is_scene_file(o.scene) ? read_scene_file(o.scene) : SceneDescription();
  const std::optional<UpAxis> up_axis = parse_up_axis(o);
  const UpAxis up = up_axis ? *up_axis : scene.up_axis.value_or(UpAxis::y);
  RenderJob job;
  job.settings = make_settings(o);
  const SceneShot shot = shot_of(o.scene);
  job.settings.ambient = scene.ambient.value_or(shot.ambient.value_or(job.settings.ambient));
  job.settings.background = scene.background.value_or(shot.background.value_or(job.settings.background));
  job.frames = parse_frame_spec(o.frames);
  job.threads = thread_count(o);
  job.accel = o.accel;
  job.gl = {o.gl, o.device, o.require_hardware};
  job.shaders = o.shaders.empty() ? gl::embedded_shaders() : gl::load_shaders(o.shaders);

  job.most_bytes = parse_max_memory(o.max_memory);
  const auto& lights = scene.lights ? scene.lights : shot.lights;
  require_room_for_frames(job.settings, light_count(o, lights), job.threads, job.frames.count(), job.most_bytes);

  ThreadPool pool(job.threads);
  job.scene = load_scene(o.scene, pool, warnings, up_axis, {job.most_bytes, progress, read_texels});
  require_room_for_scene(o.scene,
                         estimate_memory(job.scene, make_scene_facts(job.scene), job.settings, job.accel,
                                         light_count(o, lights), /*light_moves=*/true, job.threads, job.frames.count())
                             .total(),
                         job.most_bytes);
  job.motion.sequence = make_sequence(o, job.frames);
  Surroundings surroundings = Surroundings::outside;
  job.motion.course = make_course(o, job, up, surroundings, pool, warnings);
  job.lights = make_lights(o, job, up, lights, surroundings, warnings);
  return job;
}

}  // namespace hybridrt::cli
