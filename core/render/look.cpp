#include "core/render/look.h"

#include <algorithm>

namespace hybridrt {
namespace {

/// Decided by the shading normal: a file's normals are more reliable than its winding, unless that is known to be
/// right.
bool shows_back_face(const Scene& scene, const Topology& topology, const Hit<float>& hit, const vec3& dir) {
  if (topology.component_of(hit.triangle).winding != Winding::none) {
    const vec3 a = scene.vertex(hit.triangle, 0);
    return glm::dot(glm::cross(scene.vertex(hit.triangle, 1) - a, scene.vertex(hit.triangle, 2) - a), dir) > 0;
  }
  const uvec3& corners = scene.triangle_normals[hit.triangle];
  const vec3 normal = (1 - hit.u - hit.v) * scene.normals[corners[0]] + hit.u * scene.normals[corners[1]] +
                      hit.v * scene.normals[corners[2]];
  return glm::dot(normal, dir) > 0;
}

}  // namespace

Seen look(const World& world, const std::vector<Ray<float>>& rays) {
  std::vector<Hit<float>> hits(rays.size());
  world.caster.closest_hits(rays, hits);
  Seen seen;
  seen.rays = static_cast<int>(rays.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) continue;
    ++seen.hits;
    seen.hit_triangles.push_back(hits[i].triangle);
    seen.triangles.insert(hits[i].triangle);
    seen.back_faces += shows_back_face(world.scene, world.topology, hits[i], rays[i].dir);
    seen.box.grow(rays[i].origin + hits[i].t * rays[i].dir);
    seen.sum_distance += hits[i].t;
    seen.least_distance = std::min<double>(seen.least_distance, hits[i].t);
  }
  return seen;
}

std::vector<vec3> sphere_directions(int count) {
  std::vector<vec3> directions;
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2 * i + 1.0) / count, angle = i * kPi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - y * y);
    directions.push_back(vec3(r * std::cos(angle), y, r * std::sin(angle)));
  }
  return directions;
}

Seen look_around(const World& world, const vec3& eye, const std::vector<vec3>& directions) {
  std::vector<Ray<float>> rays;
  for (const vec3& dir : directions) rays.push_back({eye, dir});
  return look(world, rays);
}

}  // namespace hybridrt
