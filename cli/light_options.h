#pragma once

#include "cli/render_options.h"
#include "core/render/default_view.h"
#include "core/scene/up_axis.h"

namespace hybridrt::cli {

/// The light that flags ask for, in the colour of the first of `of_scene`; or else those `of_scene`, or else one that
/// suits the surroundings, the first of them where the camera path's keys say. `job.motion` is already known. Throws
/// Error(usage).
LightMotion make_lights(const RenderOptions& options, const RenderJob& job, UpAxis up_axis,
                        const std::optional<std::vector<DirectionalLight>>& of_scene, Surroundings surroundings,
                        Warnings& warnings);

/// How many make_lights() will make.
size_t light_count(const RenderOptions& options, const std::optional<std::vector<DirectionalLight>>& of_scene);

}  // namespace hybridrt::cli
