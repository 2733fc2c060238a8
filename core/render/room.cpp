#include "core/render/room.h"

#include <algorithm>

namespace hybridrt {
namespace {

constexpr double kMoreInside = 1.3;  // as many times the triangles seen from outside: a building
constexpr double kClosed = 0.95;     // share of rays from inside that meet a wall
constexpr double kRoofed = 0.8;      // the same where back faces already show that these are walls
constexpr double kFairPart = 0.5;    // of the scene's extent: smaller rooms are things with a hollow
constexpr double kSecondSkin = 0.5;  // of the room's volume: what a thing in it does not fill
constexpr double kOneThing = 0.6;    // of the hits: fewer on any one component, and walls are several
constexpr double kShown = 0.01;      // of the hits: enough on what only a room shows
constexpr double kHidden = 0.5;      // of the share of hits inside: seen as rarely from outside

double volume(const Aabb& box) {
  const dvec3 extent(box.extent());
  return extent.x * extent.y * extent.z;
}

bool is_within(const Aabb& inner, const Aabb& outer) {
  const vec3 tolerance = 1e-4f * outer.extent();  // of the hits by which we know the walls
  return glm::all(glm::greaterThanEqual(inner.lo, outer.lo - tolerance)) &&
         glm::all(glm::lessThanEqual(inner.hi, outer.hi + tolerance));
}

std::vector<Aabb> component_boxes(const World& world) {
  std::vector<Aabb> boxes(world.topology.components.size());
  for (uint32_t t = 0; t < world.scene.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      boxes[world.topology.component_of_triangle[t]].grow(world.scene.vertex(t, corner));
  return boxes;
}

/// For each component how many of the hits are on it.
std::vector<int> hits_of_components(const World& world, const Seen& seen) {
  std::vector<int> hits(world.topology.components.size());
  for (const uint32_t triangle : seen.hit_triangles) ++hits[world.topology.component_of_triangle[triangle]];
  return hits;
}

/// Whether what is seen around is a room. It spans much of the scene; and its walls are several things, or there is
/// something in it: most other things are between the walls, or it shows what cannot be seen from outside. A body that
/// holds nothing is only wound inside out; so is one that a second skin fills.
bool is_room(const World& world, const Seen& around, const Seen& outside) {
  if (glm::length(around.box.extent()) < kFairPart * glm::length(world.scene.bounds.extent())) return false;
  const std::vector<Aabb> boxes = component_boxes(world);
  const std::vector<int> hits = hits_of_components(world, around), outside_hits = hits_of_components(world, outside);
  const auto walls = static_cast<size_t>(std::max_element(hits.begin(), hits.end()) - hits.begin());
  size_t between = 0;
  int hidden = 0;
  for (size_t c = 0; c < boxes.size(); ++c) {
    if (c == walls) continue;
    if (outside_hits[c] * around.hits < kHidden * hits[c] * outside.hits) hidden += hits[c];
    if (!is_within(boxes[c], around.box)) continue;
    ++between;
    if (world.topology.components[c].winding == Winding::outward && volume(boxes[c]) > kSecondSkin * volume(around.box))
      return false;
  }
  return hits[walls] < kOneThing * around.hits || hidden >= kShown * around.hits || 2 * between >= boxes.size();
}

}  // namespace

bool is_roofed_room(const World& world, const vec3& spot, const Seen& outside) {
  const Seen seen = look_around(world, spot, sphere_directions(500));
  return seen.hits >= kRoofed * seen.rays && is_room(world, seen, outside);
}

bool inside_shows_more(const World& world, const vec3& spot, const Seen& outside) {
  const Seen inside = look_around(world, spot, sphere_directions(std::max(outside.hits, 1)));
  return inside.hits >= kClosed * inside.rays &&
         static_cast<double>(inside.triangles.size()) > kMoreInside * static_cast<double>(outside.triangles.size()) &&
         is_room(world, inside, outside);
}

bool is_in_solid(const World& world, const vec3& eye) {
  const Seen seen = look_around(world, eye, sphere_directions(500));
  const auto is_body = [&](uint32_t triangle) {
    return world.topology.component_of(triangle).winding == Winding::outward;
  };
  const auto on_bodies = std::count_if(seen.hit_triangles.begin(), seen.hit_triangles.end(), is_body);
  return static_cast<double>(on_bodies) >= kClosed * seen.rays && seen.back_faces >= kClosed * seen.rays;
}

bool is_in_closed_room(const World& world, const vec3& eye) {
  const Seen seen = look_around(world, eye, sphere_directions(500));
  return seen.hits >= kClosed * seen.rays && seen.back_share() < 0.5;
}

}  // namespace hybridrt
