#pragma once

#include <array>
#include <vector>

#include "core/image/image.h"
#include "core/passes_cpu/shade.h"
#include "core/raster/visibility.h"
#include "core/render/frame_plan.h"
#include "core/render/frame_timings.h"
#include "core/trace/ray_generations.h"
#include "core/trace/seen_points.h"
#include "core/trace/tile.h"

namespace hybridrt {

/// A frame's arrays, one element per pixel of the rendered part, rows from the top; those per light one light after the
/// other. Empty ones are not wanted.
struct TilePixels {
  Image& picture;  ///< linear; with four channels the last is coverage
  std::span<uint32_t> ids;
  std::span<uint8_t> mask, lit;  ///< as the GL form's (shaders/shared.h)
  std::span<vec4> traced;        ///< what reflected and refracted rays bring
};

/// What all tiles of a frame have in common; only read.
struct TileJob {
  const FramePlan& plan;
  const TraceJob& trace;
  const Clusters& clusters;
  const FrameBins& bins;
  const RayCaster<float>* caster;
  TilePixels pixels;
};

/// Milliseconds of one thread, by PassId.
using PassTimes = std::array<double, static_cast<size_t>(PassId::count)>;

/// One thread's work on the tiles of a frame.
class TileWorker {
 public:
  /// `raster` is memory that outlives the frame.
  TileWorker(const TileJob& job, TileRaster& raster);

  /// Passes 2 to 5 of one tile of the rasteriser.
  void render(int tile);

  /// The same of at most kPart_px x kPart_px pixels whose triangles primary rays find, for method raytrace: what a
  /// rasteriser saves is then the only difference.
  void render_by_rays(const Tile& part);

  static constexpr int kPart_px = 32;  ///< parts of a tile that trace their rays together

  const TraceStats& stats() const { return stats_; }
  const PassTimes& times_ms() const { return times_ms_; }

 private:
  static constexpr int kBatchRows = SeenPoints::kMost / kPart_px;

  /// Which triangle pixel (x, y) sees is triangles[(y - y_px) * stride + x - x_px].
  struct SeenTriangles {
    const uint32_t* triangles;
    int x_px, y_px, stride;
  };

  void render_part(int x0, int y0, int x1, int y1);
  void prefetch(uint32_t triangle) const;
  void prefetch_corners(uint32_t triangle) const;
  void take_points(int x0, int y0, int x1, int y1);
  void light_points();
  void ask_light(size_t light);
  void keep_masks(size_t light);
  void scatter_points(int part_x0, int part_y0);
  void add_traced(int x0, int y0, int x1, int y1);
  void keep_colors();
  float* pixel(int x, int y) const { return &job_.pixels.picture.data[index_of(x, y) * job_.pixels.picture.channels]; }
  size_t index_of(int x, int y) const { return static_cast<size_t>(y) * job_.plan.view.width_px + x; }

  const TileJob& job_;
  const Scene& scene_;
  TileRaster& raster_;
  RayGenerations<float> generations_;
  SeenPoints points_;
  std::vector<uint8_t> lit_;  ///< per point: bit l is set where light l arrives
  float colors_[3][SeenPoints::kRoom];
  SeenTriangles seen_{};

  // Of the part at hand.
  std::vector<Ray<float>> primary_;
  std::vector<uint32_t> primary_pixels_, primary_triangles_;
  std::vector<Hit<float>> hits_;
  std::vector<vec3> traced_;
  bool scattered_ = false;  ///< whether any of its points sent rays

  // Of the light at hand.
  std::vector<ShadowQuery> queries_, marked_queries_;
  std::vector<int> asking_, marked_;  ///< the points of these queries
  std::vector<CellAnswer> answers_;
  std::vector<uint8_t> occluded_;

  TraceStats stats_;
  PassTimes times_ms_{};
};

}  // namespace hybridrt
