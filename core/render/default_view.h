#pragma once

#include "core/render/look.h"
#include "core/scene/camera.h"

namespace hybridrt {

enum class Surroundings {
  outside,  ///< objects, seen from all around
  open,     ///< a room that is open on one side, seen from there
  inside,   ///< a closed room: the camera stands where there is most space and looks around once
};

/// The camera's way around a scene when none is given.
struct DefaultView {
  Surroundings surroundings = Surroundings::outside;
  Orbit orbit;
};

/// A scene is a room if most of what would be seen from outside is back faces, or if it is closed and more of its
/// triangles are seen from its roomiest point than from all around. To stand in it, it must also span at least half of
/// the scene's extent, and not be one thing with nothing in it. About 100,000 rays are traced.
DefaultView choose_default_view(const World& world, double aspect, double fov_y_rad);

}  // namespace hybridrt
