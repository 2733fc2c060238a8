#pragma once

#include <cstdint>
#include <span>

namespace hybridrt {

/// How far the outlines of two pictures are apart, in pixels: the smallest number d of steps (a step goes to any of the
/// eight neighbours) such that every pixel that one picture covers is within d of one that the other covers; the
/// Hausdorff distance of what they cover. 0: both cover the same. If only one covers anything: the larger side. `a`,
/// `b`: 1 where something is seen; rows of `width_px`.
int outline_distance(std::span<const uint8_t> a, std::span<const uint8_t> b, int width_px);

}  // namespace hybridrt
