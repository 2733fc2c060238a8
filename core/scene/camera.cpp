#include "core/scene/camera.h"

#include <algorithm>

namespace hybridrt {
namespace {

constexpr double kOrbitElevation_rad = 22 * kPi / 180;
constexpr double kOrbitStart_rad = 30 * kPi / 180;  // a three-quarter view of things that face +z
constexpr double kMargin = 1.04;

}  // namespace

Camera camera_on_orbit(const Orbit& orbit, double fraction) {
  const double azimuth = orbit.from_rad + fraction * (orbit.to_rad - orbit.from_rad);
  Camera camera;
  camera.target_world = orbit.target_world;
  camera.eye_world = orbit.target_world +
                     dvec3(std::sin(azimuth) * orbit.radius, orbit.height, std::cos(azimuth) * orbit.radius);
  camera.fov_y_rad = orbit.fov_y_rad;
  return camera;
}

Orbit default_orbit(const Aabb& bounds, const dvec3& scene_origin_world, double aspect, double fov_y_rad) {
  // Seen from all around, the box sweeps an upright cylinder. Far enough is where every point of its two
  // rims fits between the picture's edges; a rim point at (x, y) across and z toward the eye needs
  // distance >= z + |x| / tan_half_width and >= z + |y| / tan_half_height.
  const dvec3 half = 0.5 * dvec3(bounds.extent());
  const double cylinder_radius = std::hypot(half.x, half.z);
  const double tan_half_height = std::tan(0.5 * fov_y_rad), tan_half_width = tan_half_height * aspect;
  const double sine = std::sin(kOrbitElevation_rad), cosine = std::cos(kOrbitElevation_rad);
  double distance = 0;
  for (int step = 0; step < 360; ++step) {
    const double angle = step * kPi / 180;
    const double across = cylinder_radius * std::sin(angle), away = cylinder_radius * std::cos(angle);
    for (double height : {-half.y, half.y}) {
      const double toward_eye = away * cosine + height * sine;
      const double upward = height * cosine - away * sine;
      distance = std::max({distance, toward_eye + std::abs(across) / tan_half_width,
                           toward_eye + std::abs(upward) / tan_half_height});
    }
  }
  if (!(distance > 0)) distance = 1;  // a scene that is one point

  Orbit orbit;
  orbit.target_world = scene_origin_world + dvec3(bounds.center());
  orbit.radius = kMargin * distance * cosine;
  orbit.height = kMargin * distance * sine;
  orbit.from_rad = kOrbitStart_rad;
  orbit.to_rad = kOrbitStart_rad + 2 * kPi;
  orbit.fov_y_rad = fov_y_rad;
  return orbit;
}

dvec3 default_light_toward(const Camera& camera) {
  const dvec3 up(0, 1, 0);
  dvec3 back = camera.eye_world - camera.target_world;
  back -= glm::dot(back, up) * up;
  back = glm::length(back) > 0 ? glm::normalize(back) : dvec3(0, 0, 1);
  const dvec3 left = glm::cross(back, up);
  return glm::normalize(1.2 * up + 0.7 * left + 0.6 * back);
}

}  // namespace hybridrt
