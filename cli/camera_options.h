#pragma once

#include "cli/render_options.h"
#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/render/default_view.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// The camera of a run, and what choosing it found out.
struct ChosenCamera {
  CameraCourse course;
  Surroundings surroundings = Surroundings::outside;
  SceneCaster<float> caster;  ///< for the scene, if the default view needed rays
};

/// The camera of the options, else the source's own, else the default view of `job.scene` for pictures of
/// `job.settings`. `up_axis` is that of the scene's files. Throws Error(usage) for options, Error(input) for files.
ChosenCamera choose_camera(const RenderOptions& options, const SceneSource& source, const RenderJob& job,
                           UpAxis up_axis, ThreadPool& pool, Warnings& warnings);

}  // namespace hybridrt::cli
