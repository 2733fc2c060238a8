#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"

namespace hybridrt {

/// For each position the smallest index of an equal one (its own, mostly). Equal means equal to the bit, except that -0
/// equals 0: a mesh whose exporter gave every face its own vertices becomes connected again. Expected time is linear,
/// the result the same for any number of threads. Throws CheckFailed beyond 2^31 positions.
std::vector<uint32_t> weld_positions(std::span<const vec3> positions, ThreadPool& pool);

}  // namespace hybridrt
