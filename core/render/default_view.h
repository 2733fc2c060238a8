#pragma once

#include "core/mesh/topology.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/ray_caster.h"

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
/// the scene's extent, and not be one thing with nothing in it. `topology` and `caster` must belong to `scene`; about
/// 100,000 rays are traced.
DefaultView choose_default_view(const Scene& scene, const Topology& topology, const RayCaster<float>& caster,
                                double aspect, double fov_y_rad);

/// The light when none is given. Together with the ambient light it makes a white surface that faces it just white.
/// Outside it comes from above, left of and behind `camera`; through a room's open side it comes in lower, so that it
/// reaches the far wall. In a closed room, where no outside light gets in, the camera carries it and it casts no
/// shadows (`camera` is then that of each frame, else that of the first).
DirectionalLight default_light(Surroundings surroundings, const Camera& camera, const vec3& ambient);

}  // namespace hybridrt
