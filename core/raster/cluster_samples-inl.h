// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_CLUSTER_SAMPLES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_CLUSTER_SAMPLES_H
#undef HYBRIDRT_RASTER_CLUSTER_SAMPLES_H
#else
#define HYBRIDRT_RASTER_CLUSTER_SAMPLES_H
#endif

#include "core/raster/cluster_triangles-inl.h"
#include "core/raster/pixel_samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// Draws clusters into several samples of some of a tile's pixels; the counterpart of ClusterDraw.
class ClusterSamples {
 public:
  ClusterSamples(const Scene& scene, const Clusters& clusters, const Screen& screen, ClusterScratch& scratch,
                 DepthTile& tile, PixelSamples& samples)
      : scene_(scene),
        screen_(screen),
        tile_(tile),
        samples_(samples),
        sampler_(tile, samples),
        triangles_(scene, clusters, screen, scratch, tile) {}

  /// `box`: pixels of the picture that the cluster may touch in the tile.
  void draw(const Cluster& cluster, const PixelBox& box) {
    const int count = triangles_.begin(cluster, box);
    for (int first = 0; first < count; first += kLanes) {
      const Mask live = first_lanes(count - first);
      Mask sliver;
      const LaneTriangles t = triangles_.set_up(first, live, sliver);
      const StoredTriangles stored(t);
      for (uint32_t bits = bits_of(hn::AndNot(sliver, live)); bits != 0; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        if (!hides(tile_, triangles_.box_of(stored, i), stored.nearest[i]))
          sampler_.sample(triangles_.edges_of(stored, i), triangles_.holes_of(i));
      }
      triangles_.for_each_sliver(t, bits_of(sliver), [&](const HomogeneousTriangle& one, const PixelBox& in_picture) {
        sampler_.sample(one, in_picture);
      });
    }
  }
  void draw(const HomogeneousTriangle& triangle, const PixelBox& box) { sampler_.sample(triangle, box); }

  void settle() { hybridrt::settle(scene_, screen_, samples_, tile_); }

 private:
  const Scene& scene_;
  const Screen& screen_;
  DepthTile& tile_;
  PixelSamples& samples_;
  PixelSampler sampler_;
  ClusterTriangles triangles_;
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
