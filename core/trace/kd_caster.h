#pragma once

#include <memory>

#include "core/trace/kd_tree.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// How leaves are tested. Both give the same hits to the last bit.
enum class LeafKernel {
  scalar,
  simd,  ///< four triangles at a time, on the best instruction set that the processor has
};

/// Rays against a kd-tree, in float. Among hits at exactly the same t the lowest triangle index wins; rays
/// that are not finite or have no direction hit nothing. `tree` must outlive the caster.
std::unique_ptr<RayCaster<float>> make_kd_caster(const KdTree& tree, LeafKernel kernel);

/// The truth: the same traversal and triangle test in double on the same triangles. `tree` must outlive it.
std::unique_ptr<RayCaster<double>> make_reference_caster(const KdTree& tree);

}  // namespace hybridrt
