#pragma once

#include "core/render/default_view.h"

namespace hybridrt {

/// The light when none is given. Together with the ambient light it makes a white surface that faces it just white.
/// Outside it comes from above, left of and behind `camera`; through a room's open side it comes in lower, so that it
/// reaches the far wall. In a closed room, where no outside light gets in, the camera carries it and it casts no
/// shadows (`camera` is then that of each frame, else that of the first).
DirectionalLight default_light(Surroundings surroundings, const Camera& camera, const AmbientLight& ambient);

/// The colour with which a light from `toward` (unit) makes a white surface that faces it just white.
vec3 color_beside(const AmbientLight& ambient, const dvec3& toward);

/// The ambient light when neither it nor lights are given: stronger from above and from the side that a light from
/// `toward` (unit) leaves dark, so that a turntable shows form all the way round. In a closed room it is even.
AmbientLight default_ambient(Surroundings surroundings, const dvec3& toward);

}  // namespace hybridrt
