// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_CLUSTER_SCRATCH_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_CLUSTER_SCRATCH_H
#undef HYBRIDRT_RASTER_CLUSTER_SCRATCH_H
#else
#define HYBRIDRT_RASTER_CLUSTER_SCRATCH_H
#endif

#include "core/raster/clusters.h"
#include "core/raster/depth_tile.h"
#include "core/raster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// Boxes up to so many pixels wide and high are sampled a triangle a lane; other boxes up to kNarrow_px wide a row a
/// lane (grass, wires, strips), the rest a pixel a lane.
constexpr int kSmall_px = 8, kNarrow_px = 16;

/// Rounding of single precision.
constexpr float kU = 0x1p-24f;

/// Memory of one thread for the cluster at hand.
struct ClusterScratch {
  HWY_ALIGN float x[kClusterVertices], y[kClusterVertices], depth[kClusterVertices];  ///< of the vertices

  /// Of the triangles whose box holds the centre of a pixel: corners, box, packed corner numbers.
  static constexpr int kRoom = kClusterTriangles + kLongestVector;
  HWY_ALIGN float corner_x[3][kRoom], corner_y[3][kRoom], box_x0[kRoom], box_x1[kRoom], box_y0[kRoom], box_y1[kRoom];
  HWY_ALIGN uint32_t corners[kRoom];

  /// Samples that are certainly hit and wait to be compared with the tile, one by one: two triangles of a vector may
  /// hold the same pixel.
  static constexpr int kFullAt = 2048;
  static constexpr int kSampleRoom = kFullAt + kLongestVector * kSmall_px * kSmall_px +
                                     kNarrow_px * (kTileHeight_px + kLongestVector) + kLongestVector;
  HWY_ALIGN float lo[kSampleRoom], hi[kSampleRoom];
  HWY_ALIGN uint32_t place[kSampleRoom], number[kSampleRoom];
  int sample_count = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
