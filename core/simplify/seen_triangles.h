#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/parallel.h"
#include "core/mesh/topology.h"
#include "core/raster/visibility.h"
#include "core/simplify/view_bounds.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// Finds which triangles frames see: directly, in mirrors and through glass, and by their shadows. The scene must
/// outlive it.
class SeenTriangles {
 public:
  /// `depth`: generations of reflected and refracted rays.
  SeenTriangles(const Scene& scene, int depth, ThreadPool& pool);

  /// One sample a pixel, at view.sample_px: the triangle that the exact rasteriser finds there, those that its rays
  /// meet while they carry light that could change a pixel, and of each of these points the first one between it and
  /// each light.
  void look(const Sight& sight);

  /// 1 for each triangle that was seen, or shares a vertex (welded) with one that was: what samples have missed lies
  /// beside what they found. A component whose material lets light through is kept whole, as it has an inside.
  std::vector<uint8_t> kept(const Topology& topology) const;

  size_t seen_count() const;

 private:
  struct Waiting {
    Ray<float> ray;
    vec3 weight;
    int generation;
  };
  void see(uint32_t triangle) { seen_[triangle].store(1, std::memory_order_relaxed); }
  void look_along_row(const Sight& sight, int y, std::vector<Waiting>& waiting);
  void follow(const Sight& sight, std::vector<Waiting>& waiting);

  const Scene& scene_;
  const int depth_;
  ThreadPool& pool_;
  const Clusters clusters_;
  const std::unique_ptr<RayCaster<float>> caster_;
  RasterMemory raster_;
  std::vector<uint32_t> ids_;
  std::vector<std::atomic<uint8_t>> seen_;  ///< by triangle
};

}  // namespace hybridrt
