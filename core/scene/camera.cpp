#include "core/scene/camera.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace hybridrt {
namespace {

constexpr double kOrbitElevation_rad = 22 * kPi / 180;
constexpr double kOrbitStart_rad = 30 * kPi / 180;  // a three-quarter view of things that face +z
constexpr double kMargin = 1.04;

/// Turned about the upright axis through its middle, a scene sweeps a solid of revolution; this is a level slice of
/// that solid.
struct Slice {
  double height, radius;
};
using Silhouette = std::vector<Slice>;

constexpr int kSlices = 64;

Silhouette sweep(const Scene& scene, const Aabb& framed) {
  const dvec3 middle(framed.center());
  const double bottom = framed.lo.y, height = std::max(0.0f, framed.extent().y);
  std::vector<double> squared(kSlices, -1.0);
  for (const uvec3& triangle : scene.triangle_positions)
    for (int corner = 0; corner < 3; ++corner) {
      if (!framed.holds(scene.positions[triangle[corner]])) continue;
      const dvec3 p(scene.positions[triangle[corner]]);
      const double share = height > 0 ? (p.y - bottom) / height : 0;
      double& slice = squared[std::clamp(static_cast<int>(share * kSlices), 0, kSlices - 1)];
      slice = std::max(slice, (p.x - middle.x) * (p.x - middle.x) + (p.z - middle.z) * (p.z - middle.z));
    }
  Silhouette silhouette;
  for (int i = 0; i < kSlices; ++i)
    if (squared[i] >= 0)
      for (int edge : {i, i + 1}) silhouette.push_back({bottom + height * edge / kSlices, std::sqrt(squared[i])});
  return silhouette;
}

struct Picture {
  double tan_half_width, tan_half_height;
};

/// The distance from which all rims of the silhouette fit between the picture's edges: a point (x, y) across and z
/// toward the eye needs z + |x| / tan_half_width and z + |y| / tan_half_height.
double distance_for(const Silhouette& silhouette, double target_height, const Picture& picture) {
  const double sine = std::sin(kOrbitElevation_rad), cosine = std::cos(kOrbitElevation_rad);
  double distance = 0;
  for (int step = 0; step <= 90; ++step) {  // one half; the other is its mirror image
    const double angle = step * kPi / 90;
    for (const Slice& slice : silhouette) {
      const double across = slice.radius * std::sin(angle), away = slice.radius * std::cos(angle);
      const double above = slice.height - target_height;
      const double toward_eye = away * cosine + above * sine, upward = above * cosine - away * sine;
      distance = std::max({distance, toward_eye + across / picture.tan_half_width,
                           toward_eye + std::abs(upward) / picture.tan_half_height});
    }
  }
  return distance;
}

}  // namespace

bool up_is_along_view(const Camera& camera) {
  constexpr double kSmallestSine = 1e-6;
  const double length = glm::length(camera.up);
  if (!(length > 0)) return true;
  const dvec3 gaze = glm::normalize(camera.target_world - camera.eye_world);
  return !(glm::length(camera.up - glm::dot(camera.up, gaze) * gaze) > kSmallestSine * length);
}

Camera camera_on_orbit(const Orbit& orbit, double fraction) {
  const double azimuth = orbit.from_rad + fraction * (orbit.to_rad - orbit.from_rad);
  Camera camera;
  camera.target_world = orbit.target_world;
  camera.eye_world =
      orbit.target_world + dvec3(std::sin(azimuth) * orbit.radius, orbit.height, std::cos(azimuth) * orbit.radius);
  if (orbit.outward) std::swap(camera.eye_world, camera.target_world);
  camera.fov_y_rad = orbit.fov_y_rad;
  return camera;
}

Orbit orbit_through(const Camera& camera) {
  const dvec3 away = camera.eye_world - camera.target_world;
  Orbit orbit;
  orbit.target_world = camera.target_world;
  orbit.radius = std::hypot(away.x, away.z);
  orbit.height = away.y;
  orbit.from_rad = std::atan2(away.x, away.z);
  orbit.to_rad = orbit.from_rad + 2 * kPi;
  orbit.fov_y_rad = camera.fov_y_rad;
  return orbit;
}

Orbit default_orbit(const Scene& scene, const Aabb& framed, double aspect, double fov_y_rad) {
  const Silhouette silhouette = sweep(scene, framed);
  const Picture picture{std::tan(0.5 * fov_y_rad) * aspect, std::tan(0.5 * fov_y_rad)};

  // The height to look at from which the camera comes nearest; the distance is convex in it.
  double low = silhouette.front().height, high = silhouette.back().height;
  for (int step = 0; step < 60; ++step) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (distance_for(silhouette, a, picture) < distance_for(silhouette, b, picture))
      high = b;
    else
      low = a;
  }
  const double height = 0.5 * (low + high);
  double distance = kMargin * distance_for(silhouette, height, picture);
  if (!(distance > 0)) distance = 1;  // a scene that is one point

  const vec3 middle = framed.center();
  Orbit orbit;
  orbit.target_world = scene.origin_world + dvec3(middle.x, height, middle.z);
  orbit.radius = distance * std::cos(kOrbitElevation_rad);
  orbit.height = distance * std::sin(kOrbitElevation_rad);
  orbit.from_rad = kOrbitStart_rad;
  orbit.to_rad = kOrbitStart_rad + 2 * kPi;
  orbit.fov_y_rad = fov_y_rad;
  return orbit;
}

}  // namespace hybridrt
