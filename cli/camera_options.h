#pragma once

#include "cli/render_options.h"
#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/render/default_view.h"
#include "core/render/render_job.h"
#include "core/scene/framing.h"

namespace hybridrt::cli {

/// The camera of a run, and what choosing it found out.
struct ChosenCamera {
  CameraCourse course;
  Surroundings surroundings = Surroundings::outside;  ///< where lights are not given either
  SceneCaster<float> caster;                          ///< for the scene, if the default view needed rays
};

/// The camera of the options, else the source's own, else the default view of `job.scene` for pictures of
/// `job.settings`. `framing` is that of the scene without a ground. `up_axis` is that of the scene's files. Throws
/// Error(usage) for options, Error(input) for files.
ChosenCamera choose_camera(const RenderOptions& options, const SceneSource& source, const RenderJob& job,
                           const Framing& framing, UpAxis up_axis, ThreadPool& pool, Warnings& warnings);

}  // namespace hybridrt::cli
