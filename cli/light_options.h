#pragma once

#include "cli/render_options.h"
#include "core/base/warnings.h"
#include "core/render/default_light.h"
#include "core/render/motion.h"

namespace hybridrt::cli {

/// The scene's ambient light; an even one if lights are given, or follow the camera; else one that suits the default
/// light. `camera` must be chosen already.
AmbientLight choose_ambient(const RenderOptions& options, const SceneSource& source, const CameraMotion& camera,
                            Surroundings surroundings);

/// The light of the options, in the colour of the source's first one; else the source's lights; else one that suits the
/// surroundings. The camera path's keys move the first. `camera` must be chosen already. Throws Error(usage).
LightMotion choose_lights(const RenderOptions& options, const SceneSource& source, const CameraMotion& camera,
                          const AmbientLight& ambient, UpAxis up_axis, Surroundings surroundings, Warnings& warnings);

/// How many choose_lights() will return.
size_t light_count(const RenderOptions& options, const SceneSource& source);

}  // namespace hybridrt::cli
