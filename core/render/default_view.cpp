#include "core/render/default_view.h"

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "core/scene/view.h"

namespace hybridrt {
namespace {

// Small pictures are enough to tell walls from things.
constexpr int kWidth_px = 32, kHeight_px = 24;
constexpr double kMostlyBackFaces = 0.6;  // a larger share: a room seen from outside
constexpr double kHardlyAnyBackFaces = 0.05;
constexpr double kABackdrop = 0.3;   // a larger share of back faces: something is seen from behind
constexpr double kMoreInside = 1.3;  // as many times the triangles seen from outside: a building
constexpr double kClosed = 0.95;     // share of rays from inside that meet a wall
constexpr double kRoofed = 0.8;      // the same where back faces already show that these are walls
constexpr int kAzimuths = 16;
constexpr double kMargin = 1.04;
constexpr double kSway_rad = 14 * kPi / 180, kLookInElevation_rad = 4 * kPi / 180;

/// What a bundle of rays sees.
struct Seen {
  int rays = 0, hits = 0, back_faces = 0;
  std::set<uint32_t> triangles;
  double sum_distance = 0, least_distance = std::numeric_limits<double>::infinity();

  double back_share() const { return hits ? static_cast<double>(back_faces) / hits : 0; }
};

/// Decided by the shading normal: a file's normals are more reliable than its winding.
bool shows_back_face(const Scene& scene, const Hit<float>& hit, const vec3& dir) {
  const uvec3& corners = scene.triangle_normals[hit.triangle];
  const vec3 normal = (1 - hit.u - hit.v) * scene.normals[corners[0]] + hit.u * scene.normals[corners[1]] +
                      hit.v * scene.normals[corners[2]];
  return glm::dot(normal, dir) > 0;
}

Seen look(const Scene& scene, const RayCaster<float>& caster, const std::vector<Ray<float>>& rays) {
  std::vector<Hit<float>> hits(rays.size());
  caster.closest_hits(rays, hits);
  Seen seen;
  seen.rays = static_cast<int>(rays.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) continue;
    ++seen.hits;
    seen.triangles.insert(hits[i].triangle);
    seen.back_faces += shows_back_face(scene, hits[i], rays[i].dir);
    seen.sum_distance += hits[i].t;
    seen.least_distance = std::min<double>(seen.least_distance, hits[i].t);
  }
  return seen;
}

Seen look_from(const Scene& scene, const RayCaster<float>& caster, const Camera& camera, double aspect) {
  View view = make_view(camera, scene.origin_world, kWidth_px, kHeight_px);
  view.tan_half_width = view.tan_half_height * aspect;
  std::vector<Ray<float>> rays;
  for (int y = 0; y < kHeight_px; ++y)
    for (int x = 0; x < kWidth_px; ++x) {
      Ray<float> ray;
      ray.origin = vec3(view.eye);
      ray.dir = vec3(glm::normalize(view.pixel_dir(x, y)));
      rays.push_back(ray);
    }
  return look(scene, caster, rays);
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
std::optional<Orbit> look_in(const Scene& scene, const Aabb& framed, const RayCaster<float>& caster,
                             const Orbit& around, double aspect) {
  Orbit orbit = level(around);
  double best_share = 1, best_azimuth = 0;
  for (int i = 0; i < kAzimuths; ++i) {
    orbit.from_rad = orbit.to_rad = 2 * kPi * i / kAzimuths;
    const double share = look_from(scene, caster, camera_on_orbit(orbit, 0), aspect).back_share();
    if (share < best_share) best_share = share, best_azimuth = orbit.from_rad;
  }
  if (best_share > kHardlyAnyBackFaces) return std::nullopt;
  orbit.from_rad = best_azimuth - kSway_rad;
  orbit.to_rad = best_azimuth + kSway_rad;
  orbit.target_world = scene.origin_world + dvec3(framed.center());
  const double larger =
      kMargin * distance_to_see(0.5 * dvec3(framed.extent()), orbit, aspect) / std::hypot(orbit.radius, orbit.height);
  orbit.radius *= larger;
  orbit.height *= larger;
  return orbit;
}

/// The orbit, turned so that it starts where no backdrop is seen from behind, if it would start so.
Orbit start_in_front(const Scene& scene, const RayCaster<float>& caster, Orbit orbit, double aspect) {
  const auto back_share = [&](int turn) {
    return look_from(scene, caster, camera_on_orbit(orbit, static_cast<double>(turn) / kAzimuths), aspect).back_share();
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

/// `count` directions, evenly spread over the sphere (a Fibonacci lattice).
std::vector<vec3> sphere_directions(int count) {
  std::vector<vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2 * i + 1.0) / count, angle = i * kPi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - y * y);
    directions.push_back(vec3(r * std::cos(angle), y, r * std::sin(angle)));
  }
  return directions;
}

Seen look_around(const Scene& scene, const RayCaster<float>& caster, const vec3& eye,
                 const std::vector<vec3>& directions) {
  std::vector<Ray<float>> rays;
  for (const vec3& dir : directions) rays.push_back({eye, dir});
  return look(scene, caster, rays);
}

/// The point of a grid in the scene's box with the most space around it and walls facing it, slightly below the middle,
/// as people stand.
std::optional<vec3> roomiest_point(const Scene& scene, const Aabb& framed, const RayCaster<float>& caster) {
  constexpr int kSteps = 11, kDirections = 48;
  constexpr double kFewestHits = 0.5, kMostBackFaces = 0.15, kClearance = 0.02, kEyeLevel = 0.3;
  const std::vector<vec3> directions = sphere_directions(kDirections);
  const vec3 extent = framed.extent();
  const double diagonal = glm::length(extent);
  std::optional<vec3> best;
  double best_score = 0;
  for (int z = 0; z < kSteps; ++z)
    for (int y = 0; y < kSteps; ++y)
      for (int x = 0; x < kSteps; ++x) {
        const vec3 share = (vec3(x, y, z) + 0.5f) / static_cast<float>(kSteps);
        const vec3 eye = framed.lo + share * extent;
        const Seen seen = look_around(scene, caster, eye, directions);
        if (seen.hits < kFewestHits * seen.rays || seen.back_share() > kMostBackFaces ||
            seen.least_distance < kClearance * diagonal)
          continue;
        const double score = seen.sum_distance / seen.hits * (1 - std::abs(share.y - kEyeLevel));
        if (score > best_score) best_score = score, best = eye;
      }
  return best;
}

/// An orbit that stands at `spot` and first looks where the view is longest.
Orbit stand_at(const Scene& scene, const RayCaster<float>& caster, const vec3& spot, double fov_y_rad) {
  constexpr int kDirections = 64;
  const auto distance_along = [&](double angle) {
    const Seen seen = look_around(scene, caster, spot, {vec3(std::sin(angle), 0, std::cos(angle))});
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
  orbit.target_world = scene.origin_world + dvec3(spot) + 0.5 * distance_along(azimuth + kPi) * backward;
  orbit.outward = true;
  orbit.radius = glm::length(scene.bounds.extent());
  orbit.from_rad = azimuth;
  orbit.to_rad = azimuth + 2 * kPi;
  orbit.fov_y_rad = fov_y_rad;
  return orbit;
}

/// Looks from all around, alternately from above and from below.
Seen look_from_all_around(const Scene& scene, const RayCaster<float>& caster, Orbit around, double aspect) {
  Seen all;
  for (int i = 0; i < kAzimuths; ++i) {
    around.height = -around.height;
    const Camera camera = camera_on_orbit(around, static_cast<double>(i) / kAzimuths);
    Seen seen = look_from(scene, caster, camera, aspect);
    all.hits += seen.hits;
    all.back_faces += seen.back_faces;
    all.triangles.merge(seen.triangles);
  }
  return all;
}

/// Whether there is a room around `spot`: foliage shows back faces too, but with sky between them.
bool is_roofed(const Scene& scene, const RayCaster<float>& caster, const vec3& spot) {
  const Seen seen = look_around(scene, caster, spot, sphere_directions(500));
  return seen.hits >= kRoofed * seen.rays;
}

/// Whether walls are seen from `spot` in all directions, and more of the scene than from outside with the same number
/// of rays.
bool inside_shows_more(const Scene& scene, const RayCaster<float>& caster, const vec3& spot, const Seen& outside) {
  const Seen inside = look_around(scene, caster, spot, sphere_directions(std::max(outside.hits, 1)));
  return inside.hits >= kClosed * inside.rays &&
         static_cast<double>(inside.triangles.size()) > kMoreInside * static_cast<double>(outside.triangles.size());
}

}  // namespace

bool is_in_closed_room(const Scene& scene, const RayCaster<float>& caster, const dvec3& eye_world) {
  const Seen seen = look_around(scene, caster, vec3(eye_world - scene.origin_world), sphere_directions(500));
  return seen.hits >= kClosed * seen.rays && seen.back_share() < 0.5;
}

DefaultView choose_default_view(const Scene& scene, const Aabb& framed, const RayCaster<float>& caster, double aspect,
                                double fov_y_rad) {
  const Orbit around = default_orbit(scene, framed, aspect, fov_y_rad);
  const Seen outside = look_from_all_around(scene, caster, around, aspect);
  const bool walls = outside.back_share() > kMostlyBackFaces;
  if (walls)
    if (const auto orbit = look_in(scene, framed, caster, around, aspect)) return {Surroundings::open, *orbit};
  const std::optional<vec3> spot = roomiest_point(scene, framed, caster);
  if (spot && (walls ? is_roofed(scene, caster, *spot) : inside_shows_more(scene, caster, *spot, outside)))
    return {Surroundings::inside, stand_at(scene, caster, *spot, fov_y_rad)};
  return {Surroundings::outside, start_in_front(scene, caster, around, aspect)};
}

}  // namespace hybridrt
