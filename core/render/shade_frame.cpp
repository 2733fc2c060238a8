#include "core/render/shade_frame.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "core/base/check.h"
#include "core/passes_cpu/shade.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

/// One thread's work on some rows.
class RowShader {
 public:
  RowShader(const TraceJob& job, const ShadedPixels& pixels, const PixelRect& kept, Image& picture)
      : job_(job), pixels_(pixels), kept_(kept), picture_(picture) {}

  void shade_row(int y) {
    const int end = kept_.x_px + kept_.width_px;
    for (int x = kept_.x_px; x < end; x += SeenPoints::kMost) {
      take_points(y, x, std::min(x + SeenPoints::kMost, end));
      if (points_.count == 0) continue;
      find_points(job_.scene, job_.view, job_.lights, points_);
      light_points();
      shade(job_, points_, lit_, colors_);
      keep_colors();
    }
  }

  int64_t hit = 0, lit = 0;

 private:
  size_t index_of(int x, int y) const { return static_cast<size_t>(y) * job_.view.width_px + x; }
  float* pixel(int x, int y) const {
    return &picture_
                .data[(static_cast<size_t>(y - kept_.y_px) * picture_.width_px + x - kept_.x_px) * picture_.channels];
  }

  /// The pixels that see a triangle; the others show the background.
  void take_points(int y, int x0, int x1) {
    const vec4 background = picture_.channels == 4 ? vec4(0) : vec4(job_.background, 0);
    points_.count = 0;
    for (int x = x0; x < x1; ++x) {
      const uint32_t triangle = pixels_.ids[index_of(x, y)];
      if (triangle == kNoTriangle) {
        std::copy_n(&background.x, picture_.channels, pixel(x, y));
        continue;
      }
      points_.x[points_.count] = x, points_.y[points_.count] = y;
      points_.triangle[points_.count++] = triangle;
    }
  }

  /// A side that faces away from a light is in shadow without a test.
  void light_points() {
    lit_.assign(points_.facing, points_.facing + points_.count);
    if (pixels_.lit.empty()) return;
    for (size_t l = 0; l < job_.lights.size(); ++l) {
      if (!job_.casts_shadow(l)) continue;
      for (int i = 0; i < points_.count; ++i)
        if (!(pixels_.lit[l * pixels_.ids.size() + index_of(points_.x[i], points_.y[i])] & HRT_MASK_LIT))
          lit_[i] &= static_cast<uint8_t>(~(1u << l));
    }
  }

  void keep_colors() {
    for (int i = 0; i < points_.count; ++i) {
      vec4 color(colors_[0][i], colors_[1][i], colors_[2][i], 1);
      if (!pixels_.traced.empty()) color += vec4(vec3(pixels_.traced[index_of(points_.x[i], points_.y[i])]), 0);
      std::copy_n(&color.x, picture_.channels, pixel(points_.x[i], points_.y[i]));
      lit += lit_[i] != 0;
    }
    hit += points_.count;
  }

  const TraceJob& job_;
  const ShadedPixels& pixels_;
  const PixelRect& kept_;
  Image& picture_;
  SeenPoints points_;
  std::vector<uint8_t> lit_;  ///< per point: bit l is set where light l arrives
  float colors_[3][SeenPoints::kRoom];
};

}  // namespace

void shade_frame(const TraceJob& job, ThreadPool& pool, const ShadedPixels& pixels, const PixelRect& kept,
                 Image& picture, TraceStats& stats) {
  HRT_CHECK_EQ(pixels.ids.size(), static_cast<size_t>(job.view.width_px) * job.view.height_px);
  HRT_CHECK(pixels.lit.empty() || pixels.lit.size() == job.lights.size() * pixels.ids.size());
  HRT_CHECK(picture.width_px == kept.width_px && picture.height_px == kept.height_px);
  stats.pixels_hit = stats.pixels_lit = 0;
  std::mutex mutex;
  parallel_for(pool, static_cast<size_t>(picture.height_px), 8, [&](size_t begin, size_t end) {
    RowShader shader(job, pixels, kept, picture);
    for (size_t row = begin; row < end; ++row) shader.shade_row(kept.y_px + static_cast<int>(row));
    std::lock_guard lock(mutex);
    stats.pixels_hit += shader.hit, stats.pixels_lit += shader.lit;
  });
}

}  // namespace hybridrt
