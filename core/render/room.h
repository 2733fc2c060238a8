#pragma once

#include "core/render/look.h"

namespace hybridrt {

// A room spans much of the scene; and its walls are several things, or there is something in it. `outside` is what is
// seen from all around the scene; `spot` in scene space.

/// Whether there is a room around `spot`: foliage shows back faces too, but with sky between them.
bool is_roofed_room(const World& world, const vec3& spot, const Seen& outside);

/// Whether there is a closed room around `spot`, and more of the scene is seen than from outside with the same number
/// of rays.
bool inside_shows_more(const World& world, const vec3& spot, const Seen& outside);

/// Whether walls are seen from `eye` (scene space) in nearly all directions, and their front: the camera stands in a
/// closed room, which no light from outside enters.
bool is_in_closed_room(const World& world, const vec3& eye);

/// Whether nothing but the insides of closed bodies is seen from `eye` (scene space): the camera is in a solid.
bool is_in_solid(const World& world, const vec3& eye);

}  // namespace hybridrt
