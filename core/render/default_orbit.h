#pragma once

#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// The camera's way around a scene when nobody says where to look from.
///
/// Things are seen from all around (default_orbit()). Where most of what that would show is back faces, the
/// scene is a room: if it is open to one side, the camera sways in front of that side; else it stands inside,
/// where there is most space, and looks around once.
/// `caster` answers rays against `scene`; a few thousand are asked.
Orbit choose_default_orbit(const Scene& scene, const RayCaster<float>& caster, double aspect, double fov_y_rad);

}  // namespace hybridrt
