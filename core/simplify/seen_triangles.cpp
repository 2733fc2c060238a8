#include "core/simplify/seen_triangles.h"

#include <algorithm>

#include "core/mesh/weld.h"
#include "core/trace/embree_caster.h"
#include "core/trace/ray_generations.h"
#include "core/trace/scatter.h"

namespace hybridrt {

SeenTriangles::SeenTriangles(const Scene& scene, int depth, ThreadPool& pool)
    : scene_(scene),
      depth_(depth),
      pool_(pool),
      clusters_(make_clusters(scene, pool)),
      caster_(make_embree_caster(scene, pool.size(), EmbreeRays::single)),
      seen_(scene.triangle_count()) {}

void SeenTriangles::look(const Sight& sight) {
  const View& view = sight.view;
  ids_.resize(static_cast<size_t>(view.width_px) * static_cast<size_t>(view.height_px));
  rasterize_ids(scene_, clusters_, view, pool_, raster_, ids_);
  for (const uint32_t id : ids_)
    if (id != kNoTriangle) see(id);
  std::vector<std::vector<Waiting>> waiting(static_cast<size_t>(pool_.size()));
  pool_.run(static_cast<size_t>(view.height_px), [&](size_t y, int worker) {
    look_along_row(sight, static_cast<int>(y), waiting[static_cast<size_t>(worker)]);
  });
}

void SeenTriangles::look_along_row(const Sight& sight, int y, std::vector<Waiting>& waiting) {
  const View& view = sight.view;
  for (int x = 0; x < view.width_px; ++x) {
    const uint32_t id = ids_[static_cast<size_t>(y) * static_cast<size_t>(view.width_px) + static_cast<size_t>(x)];
    if (id == kNoTriangle) continue;
    const bool scatters = scene_.material_of(id).reflective() || scene_.material_of(id).transmissive();
    if (sight.toward_lights.empty() && !(scatters && depth_ > 0)) continue;  // the id is all
    Ray<float> ray;
    ray.origin = vec3(view.eye);
    ray.dir = vec3(glm::normalize(view.pixel_dir(x, y)));
    waiting.push_back({ray, vec3(1), 0});
    follow(sight, waiting);
  }
}

void SeenTriangles::follow(const Sight& sight, std::vector<Waiting>& waiting) {
  const auto nearest = [&](const Ray<float>& ray) {
    Hit<float> hit;
    caster_->closest_hits({&ray, 1}, {&hit, 1});
    if (hit.found()) see(hit.triangle);
    return hit;
  };
  const auto counts = [](const vec3& weight) { return std::max({weight.x, weight.y, weight.z}) >= kSmallestWeight; };
  while (!waiting.empty()) {
    const Waiting now = waiting.back();
    waiting.pop_back();
    const Hit<float> hit = nearest(now.ray);
    if (!hit.found()) continue;
    const Surface<float> surface = surface_at<float>(scene_, hit.triangle, hit.u, hit.v, now.ray.dir);
    for (const dvec3& toward_light : sight.toward_lights)
      if (const vec3 dir(toward_light); glm::dot(dir, surface.side) > 0) nearest(leave(surface, dir));
    const Material& material = scene_.materials[surface.material];
    if (now.generation == depth_ || !(material.reflective() || material.transmissive())) continue;
    const Scattered<float> out = scatter(material, surface, now.ray.dir);
    if (const vec3 weight = now.weight * out.reflected_weight; counts(weight))
      waiting.push_back({leave(surface, out.reflected_dir), weight, now.generation + 1});
    if (const vec3 weight = now.weight * out.refracted_weight; counts(weight))
      waiting.push_back({leave(surface, out.refracted_dir, /*toward=*/false), weight, now.generation + 1});
  }
}

std::vector<uint8_t> SeenTriangles::kept(const Topology& topology) const {
  const std::vector<uint32_t> welded = weld_positions(scene_.positions, pool_);
  std::vector<uint8_t> at_vertex(scene_.positions.size(), 0), whole(topology.components.size(), 0);
  for (uint32_t t = 0; t < seen_.size(); ++t) {
    if (!seen_[t]) continue;
    for (int k = 0; k < 3; ++k) at_vertex[welded[scene_.triangle_positions[t][k]]] = 1;
    if (scene_.material_of(t).transmissive()) whole[topology.component_of_triangle[t]] = 1;
  }
  std::vector<uint8_t> kept(seen_.size());
  for (uint32_t t = 0; t < seen_.size(); ++t) {
    kept[t] = whole[topology.component_of_triangle[t]];
    for (int k = 0; k < 3; ++k) kept[t] |= at_vertex[welded[scene_.triangle_positions[t][k]]];
  }
  return kept;
}

size_t SeenTriangles::seen_count() const {
  return static_cast<size_t>(std::count_if(seen_.begin(), seen_.end(), [](const auto& seen) { return seen != 0; }));
}

}  // namespace hybridrt
