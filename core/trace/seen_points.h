#pragma once

#include <cstdint>
#include <span>

#include "core/scene/view.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// What some pixels see, as far as shadow rays and shading need it. Structure of arrays; `count` elements of each are
/// used, and more may be written up to whole vectors.
struct SeenPoints {
  static constexpr int kMost = 256, kRoom = kMost + 16;

  // Given.
  int count = 0;
  int x[kRoom], y[kRoom];    ///< pixel of the view's picture
  uint32_t triangle[kRoom];  ///< that it sees

  // Found by find_points(): in double precision, as for_each_facing_light() finds them, to the last bit.
  alignas(64) double origin[3][kRoom];              ///< of shadow rays
  alignas(64) float u[kRoom], v[kRoom];             ///< barycentric weights of the second and third vertex
  alignas(64) float dir[3][kRoom], side[3][kRoom];  ///< unit: from the eye; the seen side's geometric normal
  alignas(64) float solid_angle[kRoom],
      distance[kRoom];        ///< of the pixel's sample; from the eye. If there are textures
  uint8_t from_front[kRoom];  ///< 1: the triangle's counterclockwise side is seen
  uint8_t facing[kRoom];      ///< bit l: that side faces light l
};

/// Finds the points that the pixels see. Their triangles must be what their centres see, not degenerate.
void find_points(const Scene& scene, const View& view, std::span<const TracedLight> lights, SeenPoints& points);

}  // namespace hybridrt
