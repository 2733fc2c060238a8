#pragma once

#include "cli/render_options.h"
#include "core/render/default_view.h"
#include "core/scene/up_axis.h"

namespace hybridrt::cli {

/// The camera that flags ask for, or else the scene's own, or else an orbit; `up_axis` is that of the scene's files.
/// For the default view it looks around in `job.scene`, which leaves `job.caster` behind and tells `surroundings`.
/// Throws Error(usage) for flags, Error(input) for files.
CameraCourse make_course(const RenderOptions& options, RenderJob& job, UpAxis up_axis, Surroundings& surroundings,
                         ThreadPool& pool, Warnings& warnings);

}  // namespace hybridrt::cli
