#pragma once

#include "core/scene/scene.h"

namespace hybridrt {

/// Adds a matte square under `framed` (scene space), so wide that it fills the default view up to the horizon. It lies
/// a little lower than the scene's lowest point, so that flat undersides do not touch it. `scene.bounds` grows.
void add_ground(Scene& scene, const Aabb& framed);

}  // namespace hybridrt
