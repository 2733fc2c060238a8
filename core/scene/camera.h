#pragma once

#include "core/base/math.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Where a picture is taken from, in world space.
struct Camera {
  dvec3 eye_world{0, 0, 1};
  dvec3 target_world{0};
  dvec3 up{0, 1, 0};
  double fov_y_rad = 0.7853981633974483;  ///< 45 degrees, vertical
};

/// Whether `up` lies along the view, so that another one must be taken.
bool up_is_along_view(const Camera& camera);

/// A camera's way around `target_world`, on a circle about the up axis.
struct Orbit {
  dvec3 target_world{0};
  double radius = 1;        ///< horizontal distance of the eye from the axis
  double height = 0;        ///< height of the eye above the target
  double from_rad = 0;      ///< azimuth at the first frame: 0 looks along -z, growing toward +x
  double to_rad = 2 * kPi;  ///< azimuth where the turn ends; the last frame stops one step short of it
  double fov_y_rad = 0.7853981633974483;
  bool outward = false;  ///< the eye stands at `target_world` and looks to where it would otherwise stand
};

/// One full orbit around the camera's target that starts where the camera stands.
Orbit orbit_through(const Camera& camera);

/// The eye `fraction` (0..1) of the way through the orbit.
Camera camera_on_orbit(const Orbit& orbit, double fraction);

/// An orbit about the upright axis through the middle of `framed`, slightly from above, and as near as possible with
/// all triangles of the scene that lie in `framed` (scene space; see frame_scene()) in view all the way, for a picture
/// `aspect` times as wide as high.
Orbit default_orbit(const Scene& scene, const Aabb& framed, double aspect, double fov_y_rad);

}  // namespace hybridrt
