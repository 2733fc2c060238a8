#include "cli/job.h"

#include "cli/camera_options.h"
#include "cli/light_options.h"
#include "cli/pass_forms.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/image_io/read_image.h"
#include "core/load/loading_bytes.h"
#include "core/render/memory_estimate.h"
#include "core/scene/ground.h"

namespace hybridrt::cli {
namespace {

FrameRange make_sequence(const RenderOptions& o, const FrameSpec& frames) {
  if (!o.sequence) return {frames.lowest(), frames.highest(), 1};
  if (frames.lowest() < o.sequence->first || frames.highest() > o.sequence->last)
    throw error(ErrorKind::usage, "--frames {} is not a part of --sequence {}-{}", o.frames, o.sequence->first,
                o.sequence->last);
  return *o.sequence;
}

/// Throws unless there is memory for the scene and all that a run adds to it before the first frame.
void require_room_for_run(const RenderJob& job, const SceneSource& source, size_t light_count, int threads,
                          uint64_t sheet_bytes) {
  const MemoryEstimate estimate =
      estimate_memory(job.scene, job.facts, job.topology, job.sheets, job.settings, light_count,
                      /*light_moves=*/true, threads, job.frames.count());
  require_room_for_scene(source.argument, estimate.total() + sheet_bytes, job.most_bytes);
}

}  // namespace

int thread_count(const RenderOptions& options) { return options.threads.value_or(allowed_processors()); }

void set_settings(RenderJob& job, const RenderOptions& o, const SceneSource& source, Warnings& warnings) {
  job.settings = finished_settings(o);
  job.settings.background = o.background.value_or(source.background.value_or(job.settings.background));
  job.frames = parse_frame_spec(o.frames);
  job.motion.sequence = make_sequence(o, job.frames);
  const ChosenForms forms = choose_forms(o, job.settings);
  job.settings.forms = forms.forms, job.gl = forms.gl, job.forms_reason = forms.reason;
  if (forms.warning) warnings.push_back(*forms.warning);
  job.shaders = o.shaders.empty() ? gl::embedded_shaders() : gl::load_shaders(o.shaders);
  job.most_bytes = o.most_bytes.value_or(allowed_memory());
}

Framing set_loaded_scene(RenderJob& job, const RenderOptions& o, const SceneSource& source, ThreadPool& pool,
                         Warnings& warnings, LoadProgress* progress) {
  Scene scene = load_scene(source, o.up_axis, pool, warnings,
                           {job.most_bytes, progress, {texel_size, read_texels}, o.linear_colors});
  const Framing framing = frame_scene(scene);
  if (o.ground) add_ground(scene, framing.bounds);
  set_scene(job, std::move(scene), pool, warnings, o.reflection_percent);
  require_room_for_run(job, source, light_count(o, source), pool.size(), o.sheet_bytes);
  return framing;
}

std::string scene_key(const RenderOptions& o) {
  return fmt::format("{}\n{} {} {} {}", o.scene, o.up_axis ? name_in(kUpAxes, *o.up_axis) : "", o.linear_colors,
                     o.ground, o.reflection_percent.value_or(-1));
}

void set_camera_and_lights(RenderJob& job, const RenderOptions& o, const SceneSource& source, const Framing& framing,
                           ThreadPool& pool, Warnings& warnings) {
  const UpAxis up_axis = o.up_axis ? *o.up_axis : source.up_axis.value_or(UpAxis::y);
  ChosenCamera camera = choose_camera(o, source, job, framing, up_axis, pool, warnings);
  job.motion.course = std::move(camera.course);
  if (camera.caster.caster) job.caster = std::move(camera.caster);
  job.settings.ambient = choose_ambient(o, source, job.motion, camera.surroundings);
  job.lights = choose_lights(o, source, job.motion, job.settings.ambient, up_axis, camera.surroundings, warnings);
}

RenderJob make_render_job(const RenderOptions& o, const SceneSource& source, ThreadPool& pool, Warnings& warnings,
                          LoadProgress* progress) {
  RenderJob job;
  set_settings(job, o, source, warnings);
  require_room_for_frames(job.settings, light_count(o, source), pool.size(), job.frames.count(), o.sheet_bytes,
                          job.most_bytes);
  const Framing framing = set_loaded_scene(job, o, source, pool, warnings, progress);
  set_camera_and_lights(job, o, source, framing, pool, warnings);
  if (!needs_caster(job.facts, job.settings, lights_move(job.lights, job.motion))) job.caster = {};  // for the camera
  return job;
}

}  // namespace hybridrt::cli
