#pragma once

#include "cli/render_options.h"
#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/render/default_view.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// The camera of a run, and what looking for it found.
struct ChosenCamera {
  CameraCourse course;
  Surroundings surroundings = Surroundings::outside;
  SceneCaster<float> caster;  ///< of the scene, where the default view had to look around in it
};

/// The camera that flags ask for, or else the source's own, or else the default view of `job.scene`, for pictures of
/// `job.settings`. `up_axis` is that of the scene's files. Throws Error(usage) for flags, Error(input) for files.
ChosenCamera choose_camera(const RenderOptions& options, const SceneSource& source, const RenderJob& job,
                           UpAxis up_axis, ThreadPool& pool, Warnings& warnings);

}  // namespace hybridrt::cli
