#pragma once

#include "cli/render_options.h"
#include "core/base/warnings.h"
#include "core/render/default_view.h"
#include "core/render/motion.h"

namespace hybridrt::cli {

/// The light that flags ask for, in the colour of the source's first one; or else the source's lights, or else one that
/// suits the surroundings, the first of them where the camera path's keys say. `camera` is already chosen. Throws
/// Error(usage).
LightMotion choose_lights(const RenderOptions& options, const SceneSource& source, const CameraMotion& camera,
                          const vec3& ambient, UpAxis up_axis, Surroundings surroundings, Warnings& warnings);

/// How many choose_lights() will return.
size_t light_count(const RenderOptions& options, const SceneSource& source);

}  // namespace hybridrt::cli
