#pragma once

#include <cstdint>
#include <span>

#include "core/base/math.h"

namespace hybridrt {

/// Answers batches of ray queries against a fixed scene. One virtual call per batch, none per ray. Implementations are
/// immutable after construction and safe to call from many threads at once. The scene given to a factory must outlive
/// the caster.
template <typename Real>
class RayCaster {
 public:
  virtual ~RayCaster() = default;

  /// Nearest hit of each ray with t in (t_min, t_max), or a Hit that is not found(). Triangles are
  /// two-sided. hits.size() == rays.size().
  virtual void closest_hits(std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits) const = 0;

  /// 1 where anything is hit with t in (t_min, t_max), else 0. occluded.size() == rays.size().
  virtual void any_hits(std::span<const Ray<Real>> rays, std::span<uint8_t> occluded) const = 0;
};

}  // namespace hybridrt
