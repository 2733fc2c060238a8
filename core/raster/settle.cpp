#include "core/raster/settle.h"

#include <algorithm>
#include <limits>

#include "core/trace/holes.h"
#include "core/trace/triangle.h"

namespace hybridrt {
namespace {

/// The ray of a sample, as the reference's. `dir`: its component along the camera's axis is 1.
struct SampleRay {
  ShearedRay<double> sheared;
  double length;  ///< of `dir`

  SampleRay(const dvec3& eye, const dvec3& dir)
      : sheared(shear_ray(eye, glm::normalize(dir))), length(glm::length(dir)) {}
};

/// Whether the ray meets the triangle in front of the eye, and not in a hole.
bool meets(const Scene& scene, const SampleRay& ray, uint32_t triangle, TriangleHit<double>& hit) {
  return intersect_triangle(ray.sheared, scene.vertex(triangle, 0), scene.vertex(triangle, 1),
                            scene.vertex(triangle, 2), hit) &&
         hit.t > 0 && !(scene.has_holes() && is_hole(*scene.textures, triangle, hit.u, hit.v));
}

/// What a sample sees so far.
struct SeenThere {
  float &lo, &hi;
  uint32_t& triangle;
};

/// Whether the pending sample is what is seen there from now on. `dir()`: of its ray.
template <typename Dir>
bool settle_sample(const Scene& scene, const Screen& screen, const PendingSample& sample, const Dir& dir,
                   const SeenThere& seen) {
  if (sample.nearest < seen.lo || sample.triangle == seen.triangle) return false;
  const SampleRay ray(screen.eye, dir());
  TriangleHit<double> hit;
  if (!meets(scene, ray, sample.triangle, hit)) return false;
  if (seen.triangle != kNoTriangle) {
    NearestHit<double> nearest(0, std::numeric_limits<double>::infinity());
    TriangleHit<double> seen_hit;
    // What the sample has was certainly met.
    meets(scene, ray, seen.triangle, seen_hit);
    nearest.offer(seen_hit, seen.triangle);
    if (!nearest.accepts(hit, sample.triangle)) return false;
  }
  constexpr float kRounding = 0x1p-22f;
  const float depth = static_cast<float>(screen.unit * ray.length / hit.t);
  seen.lo = depth * (1 - kRounding), seen.hi = depth * (1 + kRounding);
  seen.triangle = sample.triangle;
  return true;
}

}  // namespace

void settle(const Scene& scene, const Screen& screen, DepthTile& tile) {
  for (const PendingSample& sample : tile.pending) {
    const int x = static_cast<int>(sample.place % kTileStride), y = static_cast<int>(sample.place / kTileStride);
    const auto dir = [&] { return screen.dir(tile.x_px + x, tile.y_px + y); };
    const SeenThere seen{tile.lo[sample.place], tile.hi[sample.place], tile.triangle[sample.place]};
    if (settle_sample(scene, screen, sample, dir, seen))
      tile.block_stale[y / kBlockHeight_px * kBlocksX + x / kBlockWidth_px] = true;
  }
  tile.pending.clear();
}

void settle(const Scene& scene, const Screen& screen, PixelSamples& samples, DepthTile& tile) {
  Screen at_sample = screen;
  for (const PendingSample& sample : tile.pending) {
    const size_t pixel = sample.place / kLongestVector;
    const PixelAt at = samples.pixels[pixel];
    const auto dir = [&] {
      at_sample.frame_first = samples.frame_first[sample.place % kLongestVector];
      return at_sample.dir(at.x, at.y);
    };
    const SeenThere seen{samples.lo[sample.place], samples.hi[sample.place], samples.triangle[sample.place]};
    if (!settle_sample(scene, screen, sample, dir, seen)) continue;
    const int x = at.x - tile.x_px, y = at.y - tile.y_px;
    const float* const lo = &samples.lo[pixel * kLongestVector];
    tile.lo[y * kTileStride + x] = *std::min_element(lo, lo + samples.count);
    tile.block_stale[y / kBlockHeight_px * kBlocksX + x / kBlockWidth_px] = true;
  }
  tile.pending.clear();
}

}  // namespace hybridrt
