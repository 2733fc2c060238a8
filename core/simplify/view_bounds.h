#pragma once

#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"

namespace hybridrt {

/// From where a frame shows a scene, and the lights that cast shadows in it: unit directions toward them.
struct Sight {
  View view;
  std::vector<dvec3> toward_lights;
};

/// How far each triangle's surface may move in scene units so that no frame shows it move by more than `max_error_px`
/// pixels: reduces `bounds` (one a triangle) by the frames of `sights`.
///
/// A pixel at distance r and angle a from the middle of the view is r cos(a)^2 * 2 tan(fov / 2) / size_px wide, where
/// it is narrowest; r is that of the triangle's nearest point, a the largest of its points, at most that of the frame's
/// corners. A triangle is near wherever its shadow may fall too: anywhere along the light inside the scene's box.
/// Whether anything is in view, or hidden, does not count, as it may be seen in a mirror. 0 where the eye is in the
/// surface.
///
/// Plane and convex mirrors make nothing larger than it is from the eye; a concave mirror and a lens may.
void narrow_bounds(const Scene& scene, std::span<const Sight> sights, double max_error_px, std::vector<float>& bounds,
                   ThreadPool& pool);

/// Sets the bounds of triangles to 0 whose material reflects or bends light: what they show moves with their normals,
/// by any number of pixels.
void keep_mirrors(const Scene& scene, std::vector<float>& bounds);

}  // namespace hybridrt
