#include "core/render/edge_worker.h"

#include <array>

#include "core/render/samples.h"

namespace hybridrt {

EdgeWorker::EdgeWorker(const TileJob& job, const EdgeSampling& sampling, TileRaster* raster)
    : sampling_(sampling), tile_(job, raster) {
  for (int sample = 0; sample < sampling.samples; ++sample) {
    views_.push_back(job.plan.view);
    views_.back().sample_px = sample_offset_px(sample);
    views_.back().samples = sampling.samples;
  }
}

std::span<const vec4> EdgeWorker::take(std::span<const PixelAt> pixels, int tile) {
  triangles_.resize(pixels.size() * views_.size());
  colors_.resize(triangles_.size());
  if (tile == kByRays)
    tile_.find_by_rays(views_, pixels, triangles_);
  else
    tile_.find_in_tile(views_, tile, pixels, triangles_);
  for (int sample = sampling_.first_taken(); sample < sampling_.samples; ++sample) shade(sample, pixels);
  return std::span(colors_).subspan(sampling_.first_taken() * pixels.size());
}

void EdgeWorker::shade(int sample, std::span<const PixelAt> pixels) {
  std::array<uint32_t, TileWorker::kMostPixels> triangles;
  for (size_t first = 0; first < pixels.size(); first += triangles.size()) {
    const size_t count = std::min(triangles.size(), pixels.size() - first);
    for (size_t i = 0; i < count; ++i) triangles[i] = triangles_[(first + i) * views_.size() + sample];
    tile_.render_pixels(views_[sample], pixels.subspan(first, count), std::span(triangles).first(count),
                        std::span(colors_).subspan(sample * pixels.size() + first, count));
  }
}

}  // namespace hybridrt
