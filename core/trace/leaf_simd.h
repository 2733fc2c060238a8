#pragma once

#include <cstdint>
#include <span>

#include "core/base/math.h"
#include "core/trace/kd_tree.h"

namespace hybridrt {

// Kd-tree traversal whose leaves are tested four triangles at a time, compiled for each vector instruction set and
// dispatched once per batch to the best that the processor has (Google Highway). Same contract as RayCaster;
// bit-identical to the scalar leaf on every instruction set.
void closest_hits_simd(const KdTree& tree, std::span<const Ray<float>> rays, std::span<Hit<float>> hits);
void any_hits_simd(const KdTree& tree, std::span<const Ray<float>> rays, std::span<uint8_t> occluded);

}  // namespace hybridrt
