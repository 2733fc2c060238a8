#include "core/render/default_view.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/render/room.h"
#include "core/scene/view.h"

namespace hybridrt {
namespace {

// Small pictures are enough to tell walls from things.
constexpr int kWidth_px = 32, kHeight_px = 24;
constexpr double kMostlyBackFaces = 0.6;  // a larger share: a room seen from outside
constexpr double kHardlyAnyBackFaces = 0.05;
constexpr double kABackdrop = 0.3;  // a larger share of back faces: something is seen from behind
constexpr int kAzimuths = 16;
constexpr double kMargin = 1.04;
constexpr double kSway_rad = 14 * kPi / 180, kLookInElevation_rad = 4 * kPi / 180;

Seen look_from(const World& world, const Camera& camera, double aspect) {
  View view = make_view(camera, world.scene.origin_world, kWidth_px, kHeight_px);
  view.tan_half_width = view.tan_half_height * aspect;
  std::vector<Ray<float>> rays;
  for (int y = 0; y < kHeight_px; ++y)
    for (int x = 0; x < kWidth_px; ++x) {
      Ray<float> ray;
      ray.origin = vec3(view.eye);
      ray.dir = vec3(glm::normalize(view.pixel_dir(x, y)));
      rays.push_back(ray);
    }
  return look(world, rays);
}

/// The same distance from the target, but nearly level with it.
Orbit level(Orbit orbit) {
  const double distance = std::hypot(orbit.radius, orbit.height);
  orbit.radius = distance * std::cos(kLookInElevation_rad);
  orbit.height = distance * std::sin(kLookInElevation_rad);
  return orbit;
}

/// The distance from which all of `box` (world space) is in the picture, all the way along the orbit about its middle.
double distance_to_see(const dvec3& half_extent, const Orbit& orbit, double aspect) {
  const double tan_half_height = std::tan(0.5 * orbit.fov_y_rad), tan_half_width = aspect * tan_half_height;
  double distance = 0;
  for (int step = 0; step <= 8; ++step) {
    const Camera camera = camera_on_orbit(orbit, step / 8.0);
    const View view = make_view(camera, camera.target_world, 1, 1);
    for (int corner = 0; corner < 8; ++corner) {
      const dvec3 p = half_extent * dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      distance = std::max({distance, std::abs(glm::dot(p, view.right)) / tan_half_width - glm::dot(p, view.forward),
                           std::abs(glm::dot(p, view.up)) / tan_half_height - glm::dot(p, view.forward)});
    }
  }
  return distance;
}

/// An orbit that sways in front of the scene's open side, if there is one, with the whole opening in the picture.
std::optional<Orbit> look_in(const World& world, const Orbit& around, double aspect) {
  Orbit orbit = level(around);
  double best_share = 1, best_azimuth = 0;
  for (int i = 0; i < kAzimuths; ++i) {
    orbit.from_rad = orbit.to_rad = 2 * kPi * i / kAzimuths;
    const double share = look_from(world, camera_on_orbit(orbit, 0), aspect).back_share();
    if (share < best_share) best_share = share, best_azimuth = orbit.from_rad;
  }
  if (best_share > kHardlyAnyBackFaces) return std::nullopt;
  orbit.from_rad = best_azimuth - kSway_rad;
  orbit.to_rad = best_azimuth + kSway_rad;
  orbit.target_world = world.scene.origin_world + dvec3(world.framed.center());
  const double larger = kMargin * distance_to_see(0.5 * dvec3(world.framed.extent()), orbit, aspect) /
                        std::hypot(orbit.radius, orbit.height);
  orbit.radius *= larger;
  orbit.height *= larger;
  return orbit;
}

/// The orbit, turned so that it starts where no backdrop is seen from behind, if it would start so.
Orbit start_in_front(const World& world, Orbit orbit, double aspect) {
  const auto back_share = [&](int turn) {
    return look_from(world, camera_on_orbit(orbit, static_cast<double>(turn) / kAzimuths), aspect).back_share();
  };
  if (back_share(0) <= kABackdrop) return orbit;
  for (int turn = 0; turn <= kAzimuths; ++turn) {  // the middle of the first range of turns that is a front
    if (back_share(turn) > kHardlyAnyBackFaces) continue;
    int end = turn;
    while (end + 1 < turn + kAzimuths && back_share(end + 1) <= kHardlyAnyBackFaces) ++end;
    const double angle = 0.5 * (turn + end) / kAzimuths * (orbit.to_rad - orbit.from_rad);
    orbit.from_rad += angle;
    orbit.to_rad += angle;
    return orbit;
  }
  return orbit;
}

/// The point of a grid in the scene's box with the most space around it and walls facing it, slightly below the middle,
/// as people stand.
std::optional<vec3> roomiest_point(const World& world) {
  constexpr int kSteps = 11, kDirections = 48;
  constexpr double kFewestHits = 0.5, kMostBackFaces = 0.15, kClearance = 0.02, kEyeLevel = 0.3;
  const std::vector<vec3> directions = sphere_directions(kDirections);
  const vec3 extent = world.framed.extent();
  const double diagonal = glm::length(extent);
  std::optional<vec3> best;
  double best_score = 0;
  for (int z = 0; z < kSteps; ++z)
    for (int y = 0; y < kSteps; ++y)
      for (int x = 0; x < kSteps; ++x) {
        const vec3 share = (vec3(x, y, z) + 0.5f) / static_cast<float>(kSteps);
        const vec3 eye = world.framed.lo + share * extent;
        const Seen seen = look_around(world, eye, directions);
        if (seen.hits < kFewestHits * seen.rays || seen.back_share() > kMostBackFaces ||
            seen.least_distance < kClearance * diagonal)
          continue;
        const double score = seen.sum_distance / seen.hits * (1 - std::abs(share.y - kEyeLevel));
        if (score > best_score) best_score = score, best = eye;
      }
  return best;
}

/// An orbit that stands at `spot` and first looks where the view is longest.
Orbit stand_at(const World& world, const vec3& spot, double fov_y_rad) {
  constexpr int kDirections = 64;
  const auto distance_along = [&](double angle) {
    const Seen seen = look_around(world, spot, {vec3(std::sin(angle), 0, std::cos(angle))});
    return seen.hits ? seen.sum_distance : 0;
  };
  double longest = -1, azimuth = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * kPi * i / kDirections, distance = distance_along(angle);
    if (distance > longest) longest = distance, azimuth = angle;
  }
  // Half-way back to the wall behind, more of the room is seen.
  const dvec3 backward(-std::sin(azimuth), 0, -std::cos(azimuth));
  Orbit orbit;
  orbit.target_world = world.scene.origin_world + dvec3(spot) + 0.5 * distance_along(azimuth + kPi) * backward;
  orbit.outward = true;
  orbit.radius = glm::length(world.scene.bounds.extent());
  orbit.from_rad = azimuth;
  orbit.to_rad = azimuth + 2 * kPi;
  orbit.fov_y_rad = fov_y_rad;
  return orbit;
}

/// Looks from all around, alternately from above and from below.
Seen look_from_all_around(const World& world, Orbit around, double aspect) {
  Seen all;
  for (int i = 0; i < kAzimuths; ++i) {
    around.height = -around.height;
    const Camera camera = camera_on_orbit(around, static_cast<double>(i) / kAzimuths);
    Seen seen = look_from(world, camera, aspect);
    all.hits += seen.hits;
    all.back_faces += seen.back_faces;
    all.triangles.merge(seen.triangles);
    all.hit_triangles.insert(all.hit_triangles.end(), seen.hit_triangles.begin(), seen.hit_triangles.end());
  }
  return all;
}

}  // namespace

DefaultView choose_default_view(const World& world, double aspect, double fov_y_rad) {
  const Orbit around = default_orbit(world.scene, world.framed, aspect, fov_y_rad);
  const Seen outside = look_from_all_around(world, around, aspect);
  const bool walls = outside.back_share() > kMostlyBackFaces;
  if (walls)
    if (const auto orbit = look_in(world, around, aspect)) return {Surroundings::open, *orbit};
  const std::optional<vec3> spot = roomiest_point(world);
  if (spot && (walls ? is_roofed_room(world, *spot, outside) : inside_shows_more(world, *spot, outside)))
    return {Surroundings::inside, stand_at(world, *spot, fov_y_rad)};
  return {Surroundings::outside, start_in_front(world, around, aspect)};
}

}  // namespace hybridrt
