#pragma once

#include <set>
#include <vector>

#include "core/mesh/topology.h"
#include "core/scene/scene.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// What is looked at.
struct World {
  const Scene& scene;
  const Topology& topology;
  Aabb framed;  ///< scene space: what a picture should show (frame_scene())
  const RayCaster<float>& caster;
};

/// What a bundle of rays sees.
struct Seen {
  int rays = 0, hits = 0, back_faces = 0;
  std::vector<uint32_t> hit_triangles;  ///< of each hit
  std::set<uint32_t> triangles;
  Aabb box;  ///< of the hits
  double sum_distance = 0, least_distance = std::numeric_limits<double>::infinity();

  double back_share() const { return hits ? static_cast<double>(back_faces) / hits : 0; }
};

Seen look(const World& world, const std::vector<Ray<float>>& rays);

/// `count` directions, evenly spread over the sphere (a Fibonacci lattice).
std::vector<vec3> sphere_directions(int count);

/// `eye` in scene space.
Seen look_around(const World& world, const vec3& eye, const std::vector<vec3>& directions);

}  // namespace hybridrt
