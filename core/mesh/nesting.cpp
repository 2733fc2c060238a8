#include "core/mesh/nesting.h"

#include <algorithm>
#include <numeric>

#include "core/mesh/point_in_body.h"

namespace hybridrt {
namespace {

constexpr uint32_t kSamples = 9;        // triangles of a component
constexpr float kBoxTolerance = 1e-6f;  // of a box's size: what lies in a corner of a room is in it

/// The triangles of each component: triangles[first[c] .. first[c + 1]), ascending.
struct TrianglesOfComponents {
  std::vector<uint32_t> first, triangles;

  explicit TrianglesOfComponents(const Topology& topology) : first(topology.components.size() + 2, 0) {
    for (const uint32_t component : topology.component_of_triangle) ++first[component + 2];
    for (size_t i = 2; i < first.size(); ++i) first[i] += first[i - 1];
    triangles.resize(topology.component_of_triangle.size());
    for (uint32_t t = 0; t < triangles.size(); ++t) triangles[first[topology.component_of_triangle[t] + 1]++] = t;
  }

  std::span<const uint32_t> of(uint32_t component) const {
    return std::span(triangles).subspan(first[component], first[component + 1] - first[component]);
  }
};

dvec3 centroid(const Scene& scene, uint32_t triangle) {
  return (dvec3(scene.vertex(triangle, 0)) + dvec3(scene.vertex(triangle, 1)) + dvec3(scene.vertex(triangle, 2))) / 3.0;
}

/// Centroids of some triangles, spread over the component.
void append_samples(const Scene& scene, std::span<const uint32_t> triangles, std::vector<dvec3>& samples) {
  const size_t count = std::min<size_t>(triangles.size(), kSamples);
  for (size_t i = 0; i < count; ++i) samples.push_back(centroid(scene, triangles[i * triangles.size() / count]));
}

bool holds(const Aabb& outer, const Aabb& inner) {
  const vec3 tolerance = kBoxTolerance * outer.extent();
  return glm::all(glm::greaterThanEqual(inner.lo, outer.lo - tolerance)) &&
         glm::all(glm::lessThanEqual(inner.hi, outer.hi + tolerance));
}

/// The closed components whose contents matter, each with those that may be inside by their boxes.
struct Candidates {
  uint32_t outer;
  std::vector<uint32_t> inner;
};

std::vector<Candidates> find_candidates(const Topology& topology, const std::vector<Aabb>& boxes, ThreadPool& pool) {
  std::vector<uint32_t> by_lo_x(boxes.size()), closed, inward_by_lo_x;
  std::iota(by_lo_x.begin(), by_lo_x.end(), 0u);
  std::sort(by_lo_x.begin(), by_lo_x.end(), [&](uint32_t a, uint32_t b) { return boxes[a].lo.x < boxes[b].lo.x; });
  for (const uint32_t c : by_lo_x)
    if (topology.components[c].winding == Winding::inward) inward_by_lo_x.push_back(c);
  for (uint32_t c = 0; c < boxes.size(); ++c)
    if (topology.components[c].winding != Winding::none) closed.push_back(c);

  std::vector<Candidates> all(closed.size());
  parallel_for(pool, closed.size(), 64, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const uint32_t outer = all[i].outer = closed[i];
      const Aabb& box = boxes[outer];
      const bool is_inward = topology.components[outer].winding == Winding::inward;
      const std::vector<uint32_t>& others = is_inward ? by_lo_x : inward_by_lo_x;
      const float from = box.lo.x - kBoxTolerance * box.extent().x;
      auto at =
          std::lower_bound(others.begin(), others.end(), from, [&](uint32_t c, float x) { return boxes[c].lo.x < x; });
      for (; at != others.end() && boxes[*at].lo.x <= box.hi.x; ++at)
        if (*at != outer && holds(box, boxes[*at])) all[i].inner.push_back(*at);
    }
  });
  std::erase_if(all, [](const Candidates& c) { return c.inner.empty(); });
  return all;
}

/// Keeps those of the candidates that are inside.
void keep_insiders(const Scene& scene, const TrianglesOfComponents& triangles, Candidates& candidates) {
  std::vector<dvec3> samples;
  std::vector<size_t> first;
  for (const uint32_t inner : candidates.inner) {
    first.push_back(samples.size());
    append_samples(scene, triangles.of(inner), samples);
  }
  first.push_back(samples.size());
  const std::vector<Side> sides = sides_of(samples, scene, triangles.of(candidates.outer));
  size_t kept = 0;
  for (size_t i = 0; i < candidates.inner.size(); ++i) {
    const auto own = std::span(sides).subspan(first[i], first[i + 1] - first[i]);
    if (std::find(own.begin(), own.end(), Side::outside) == own.end() &&
        std::find(own.begin(), own.end(), Side::inside) != own.end())
      candidates.inner[kept++] = candidates.inner[i];
  }
  candidates.inner.resize(kept);
  std::sort(candidates.inner.begin(), candidates.inner.end());
}

}  // namespace

Nesting find_nesting(const Scene& scene, const Topology& topology, ThreadPool& pool) {
  Nesting nesting;
  nesting.boxes.resize(topology.components.size());
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      nesting.boxes[topology.component_of_triangle[t]].grow(scene.vertex(t, corner));
  const TrianglesOfComponents triangles(topology);
  std::vector<Candidates> candidates = find_candidates(topology, nesting.boxes, pool);
  pool.run(candidates.size(), [&](size_t i, int) { keep_insiders(scene, triangles, candidates[i]); });
  nesting.contents.resize(nesting.boxes.size());
  nesting.enclosers.resize(nesting.boxes.size());
  for (Candidates& found : candidates) {
    for (const uint32_t inner : found.inner) nesting.enclosers[inner].push_back(found.outer);
    nesting.contents[found.outer] = std::move(found.inner);
  }
  return nesting;
}

}  // namespace hybridrt
