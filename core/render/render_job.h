#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "core/base/warnings.h"
#include "core/gl/context.h"
#include "core/gl/program.h"
#include "core/render/frame.h"
#include "core/render/frame_spec.h"
#include "core/render/motion.h"
#include "core/render/scene_caster.h"

namespace hybridrt {

/// Everything that decides a run, after all inputs have been read.
struct RenderJob {
  Scene scene;
  SceneFacts facts;   ///< derived from `scene`
  Topology topology;  ///< derived from `scene`; without edges
  Sheets sheets;      ///< derived from `scene`
  RenderSettings settings;
  FrameSpec frames;
  CameraMotion motion;
  LightMotion lights;
  SceneCaster<float> caster;  ///< for `scene` by settings.accel, if it was needed already; else run() builds one
  uint64_t most_bytes = std::numeric_limits<uint64_t>::max();  ///< memory limit, by the estimates
  gl::ContextRequest gl;
  std::string forms_reason;              ///< why settings.forms is what it is, for people; empty: nobody need be told
  gl::ShaderSources shaders;             ///< for the methods that use GL
  std::function<bool(int frame)> wants;  ///< asked for each frame, in order, before it is rendered; empty: all of them
  bool repeats_still_frames = true;      ///< a frame that shows what the one before shows is not rendered again
};

/// Gives the job its scene and computes, once per run, what depends on it. Bodies that are inside out are turned, with
/// a warning (inside_out.h). `reflection_percent`: that share of the triangles becomes mirrors (reflective_share.h).
void set_scene(RenderJob& job, Scene scene, ThreadPool& pool, Warnings& warnings,
               std::optional<double> reflection_percent = std::nullopt);

/// Camera and lights of a frame.
FrameRequest frame_request(const RenderJob& job, int frame);

/// What a run used.
struct RunFacts {
  std::optional<gl::ContextInfo> gl;  ///< nothing for the methods without GL
  std::string accel;                  ///< empty if no ray could be needed
  double accel_build_ms = 0;
  double ready_ms = 0;  ///< everything before the first frame
};

/// Opens the context, builds what the job needs, renders its frames in order on the threads of `pool`. `starting` is
/// called once, before the first frame; `stop` is asked before each frame. Throws what its parts throw.
RunFacts run(const RenderJob& job, ThreadPool& pool, const std::function<void(const RunFacts&)>& starting,
             const std::function<bool()>& stop, const DeliverFrame& deliver);

}  // namespace hybridrt
