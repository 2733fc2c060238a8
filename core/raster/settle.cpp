#include "core/raster/settle.h"

#include <limits>

#include "core/trace/holes.h"
#include "core/trace/triangle.h"

namespace hybridrt {
namespace {

/// The ray of a pixel, as the reference's.
struct PixelRay {
  ShearedRay<double> sheared;
  double length;  ///< of the direction whose component along the camera's axis is 1

  PixelRay(const Screen& screen, int x, int y) {
    const dvec3 dir = screen.dir(x, y);
    length = glm::length(dir);
    sheared = shear_ray(screen.eye, glm::normalize(dir));
  }
};

/// Whether the pixel's ray meets the triangle in front of the eye, and not in a hole.
bool meets(const Scene& scene, const PixelRay& ray, uint32_t triangle, TriangleHit<double>& hit) {
  return intersect_triangle(ray.sheared, scene.vertex(triangle, 0), scene.vertex(triangle, 1),
                            scene.vertex(triangle, 2), hit) &&
         hit.t > 0 && !(scene.has_holes() && is_hole(*scene.textures, triangle, hit.u, hit.v));
}

}  // namespace

void settle(const Scene& scene, const Screen& screen, DepthTile& tile) {
  for (const PendingSample& sample : tile.pending) {
    const uint32_t place = sample.place, seen = tile.triangle[place];
    if (sample.nearest < tile.lo[place] || sample.triangle == seen) continue;
    const int x = static_cast<int>(place % kTileStride), y = static_cast<int>(place / kTileStride);
    const PixelRay ray(screen, tile.x_px + x, tile.y_px + y);
    TriangleHit<double> hit;
    if (!meets(scene, ray, sample.triangle, hit)) continue;
    if (seen != kNoTriangle) {
      NearestHit<double> nearest(0, std::numeric_limits<double>::infinity());
      TriangleHit<double> seen_hit;
      // What the pixel has was certainly met.
      meets(scene, ray, seen, seen_hit);
      nearest.offer(seen_hit, seen);
      if (!nearest.accepts(hit, sample.triangle)) continue;
    }
    constexpr float kRounding = 0x1p-22f;
    const float depth = static_cast<float>(screen.unit * ray.length / hit.t);
    tile.lo[place] = depth * (1 - kRounding), tile.hi[place] = depth * (1 + kRounding);
    tile.triangle[place] = sample.triangle;
    tile.block_stale[y / kBlockHeight_px * kBlocksX + x / kBlockWidth_px] = true;
  }
  tile.pending.clear();
}

}  // namespace hybridrt
