#pragma once

#include <vector>

#include "core/image/image.h"
#include "core/passes_cpu/shade.h"
#include "core/raster/visibility.h"
#include "core/render/frame_plan.h"
#include "core/render/pass_clock.h"
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

/// One thread's work on the tiles of a frame.
class TileWorker {
 public:
  /// `raster` is memory that outlives the frame; null if only rays find triangles.
  TileWorker(const TileJob& job, TileRaster* raster);

  /// Passes 2 to 5 of one tile of the rasteriser.
  void render(int tile);

  /// The same of at most kPart_px x kPart_px pixels whose triangles primary rays find, for method raytrace: what a
  /// rasteriser saves is then the only difference.
  void render_by_rays(const Tile& part);

  // The same of some pixels. `view`: the job's, at any sample; `views`: of several samples.

  /// Which triangles rays find there, or kNoTriangle: one per pixel and sample, a pixel's side by side.
  void find_by_rays(std::span<const View> views, std::span<const PixelAt> pixels, std::span<uint32_t> triangles);
  /// The same by the rasteriser, of pixels in a tile of the job's bins (TileRaster::find_samples).
  void find_in_tile(std::span<const View> views, int tile, std::span<const PixelAt> pixels,
                    std::span<uint32_t> triangles);
  /// `triangles`: what they see. `colors`: linear, and alpha 1 where a surface is seen, else 0. At most kMostPixels.
  void render_pixels(const View& view, std::span<const PixelAt> pixels, std::span<const uint32_t> triangles,
                     std::span<vec4> colors);
  static constexpr size_t kMostPixels = SeenPoints::kMost;

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

  void add_primary(const View& view, int x, int y, uint32_t place);
  void find_triangles();
  void render_part(int x0, int y0, int x1, int y1);
  void render_points(const View& view, PassClock& clock);
  vec4 background() const;
  void take_points(int x0, int y0, int x1, int y1, int part_y0);
  void add_point(int x, int y, uint32_t triangle, uint32_t place);
  void prefetch_all_corners() const;
  void light_points();
  void ask_light(size_t light);
  void keep_masks(size_t light);
  void scatter_points();
  void add_traced(int x0, int y0, int x1, int y1);
  void keep_colors();
  void set_pixel(int x, int y, const vec4& color) const;
  float* pixel(int x, int y) const { return &job_.pixels.picture.data[index_of(x, y) * job_.pixels.picture.channels]; }
  size_t index_of(int x, int y) const { return static_cast<size_t>(y) * job_.plan.view.width_px + x; }

  const TileJob& job_;
  const Scene& scene_;
  TileRaster* raster_;
  RayGenerations<float> generations_;
  SeenPoints points_;
  std::vector<uint8_t> lit_;            ///< per point: bit l is set where light l arrives
  uint32_t places_[SeenPoints::kRoom];  ///< per point: its pixel's place in the part
  float colors_[3][SeenPoints::kRoom];
  SeenTriangles seen_{};

  // Of the part at hand.
  std::vector<Ray<float>> primary_;
  std::vector<uint32_t> primary_places_, primary_triangles_;
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
