#pragma once

#include "cli/render_options.h"
#include "core/render/default_view.h"
#include "core/scene/up_axis.h"

namespace hybridrt::cli {

/// The light that flags ask for, or else the camera path's, or else `of_scene`, or else one that suits the
/// surroundings; `job.motion` is already known. Throws Error(usage).
LightMotion make_light(const RenderOptions& options, const RenderJob& job, UpAxis up_axis,
                       const std::optional<DirectionalLight>& of_scene, Surroundings surroundings);

}  // namespace hybridrt::cli
