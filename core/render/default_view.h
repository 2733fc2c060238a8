#pragma once

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
/// triangles are seen from its roomiest point than from all around. `framed`: scene space, what the view is to show
/// (frame_scene()). `caster` must belong to `scene`; about 100,000 rays are traced.
DefaultView choose_default_view(const Scene& scene, const Aabb& framed, const RayCaster<float>& caster, double aspect,
                                double fov_y_rad);

/// Whether walls are seen from `eye_world` in nearly all directions, and their front: the camera stands in a closed
/// room, which no light from outside enters. 500 rays are traced.
bool is_in_closed_room(const Scene& scene, const RayCaster<float>& caster, const dvec3& eye_world);

}  // namespace hybridrt
