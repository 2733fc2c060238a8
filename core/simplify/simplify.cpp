#include "core/simplify/simplify.h"

#include <algorithm>

#include "core/base/check.h"

namespace hybridrt {
namespace {

constexpr float kFirstShare = 0.7f;  // of the bounds: what samples leave open is seldom more than the rest
constexpr int kMostRounds = 20, kHalvingRounds = 3;

void require_same_topology(const Topology& before, const Topology& after) {
  HRT_CHECK_EQ(before.components.size(), after.components.size());
  HRT_CHECK_EQ(before.boundary_edges, after.boundary_edges);
  HRT_CHECK_EQ(before.inconsistent_edges, after.inconsistent_edges);
  HRT_CHECK_EQ(before.non_manifold_edges, after.non_manifold_edges);
  const auto closed = [](const Component& component) { return component.closed(); };
  HRT_CHECK_EQ(std::count_if(before.components.begin(), before.components.end(), closed),
               std::count_if(after.components.begin(), after.components.end(), closed));
}

}  // namespace

Simplified simplify(const Scene& scene, const Topology& topology, std::span<const float> bounds, ThreadPool& pool,
                    const std::function<bool()>& stop) {
  std::vector<float> working(bounds.begin(), bounds.end());
  for (float& bound : working) bound *= kFirstShare;
  Simplified result;
  do {
    HRT_CHECK(result.rounds < kMostRounds);
    ++result.rounds;
    result.scene = decimate(scene, topology, working, pool, stop);
    if (stop && stop()) return result;
    result.distance = measure_distance(scene, bounds, result.scene, pool);
    const float factor = result.rounds <= kHalvingRounds ? 0.5f : 0;
    for (size_t t = 0; t < working.size(); ++t)
      if (result.distance.exceeds[t]) working[t] *= factor;
  } while (result.distance.share > 1);
  require_same_topology(topology, build_topology(result.scene, pool));
  return result;
}

}  // namespace hybridrt
