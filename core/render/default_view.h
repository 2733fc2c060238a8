#pragma once

#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

enum class Surroundings {
  outside,  ///< things, seen from all around
  open,     ///< a room that is open to one side: seen from there
  inside,   ///< a closed room: the camera stands in it, where there is most space, and looks around once
};

/// The camera's way around a scene when nobody says where to look from.
struct DefaultView {
  Surroundings surroundings = Surroundings::outside;
  Orbit orbit;
};

/// A scene is a room if most of what would be seen from outside is back faces, or if it is closed and more of
/// its triangles are seen from its roomiest point than from all around.
/// `caster` answers rays against `scene`; about 100,000 are asked.
DefaultView choose_default_view(const Scene& scene, const RayCaster<float>& caster, double aspect, double fov_y_rad);

/// The light when nobody names one, as bright as takes a white surface that faces it, with the ambient light,
/// to just white. Outside it comes from above, left of and behind `camera`; through a room's open side
/// lower, so that it reaches the far wall. No outside light reaches a closed room: there the camera carries
/// it, and it casts no shadows (`camera` is then each frame's own, else the first one's).
DirectionalLight default_light(Surroundings surroundings, const Camera& camera, const vec3& ambient);

}  // namespace hybridrt
