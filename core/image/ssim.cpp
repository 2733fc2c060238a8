#include "core/image/ssim.h"

#include <array>
#include <cmath>
#include <vector>

#include "core/base/check.h"

namespace hybridrt {
namespace {

constexpr int kWindow_px = 11;
constexpr double kSigma_px = 1.5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;  // the paper's, for values in 0-1

/// What SSIM needs of a window: means of a, b, aa, bb and ab.
struct Moments {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
};

double similarity(const Moments& m) {
  const double variance_a = m.aa - m.a * m.a, variance_b = m.bb - m.b * m.b, covariance = m.ab - m.a * m.b;
  return (2 * m.a * m.b + kC1) * (2 * covariance + kC2) /
         ((m.a * m.a + m.b * m.b + kC1) * (variance_a + variance_b + kC2));
}

double luma(const float* pixel, int channels) {
  return channels >= 3 ? 0.299 * pixel[0] + 0.587 * pixel[1] + 0.114 * pixel[2] : pixel[0];
}

Moments moments_of(double a, double b) { return {a, b, a * a, b * b, a * b}; }

void add(Moments& sum, const Moments& m, double weight) {
  sum.a += weight * m.a, sum.b += weight * m.b;
  sum.aa += weight * m.aa, sum.bb += weight * m.bb, sum.ab += weight * m.ab;
}

std::array<double, kWindow_px> gaussian() {
  std::array<double, kWindow_px> weights;
  double sum = 0;
  for (int i = 0; i < kWindow_px; ++i) {
    const double x = i - kWindow_px / 2;
    sum += weights[i] = std::exp(-x * x / (2 * kSigma_px * kSigma_px));
  }
  for (double& w : weights) w /= sum;
  return weights;
}

/// The windows' moments along one row of pixels.
void filter_row(const Image& a, const Image& b, int y, const std::array<double, kWindow_px>& weights,
                std::vector<Moments>& pixels, std::vector<Moments>& filtered) {
  for (int x = 0; x < a.width_px; ++x)
    pixels[x] = moments_of(luma(a.pixel(x, y), a.channels), luma(b.pixel(x, y), b.channels));
  for (size_t x = 0; x < filtered.size(); ++x) {
    filtered[x] = {};
    for (int i = 0; i < kWindow_px; ++i) add(filtered[x], pixels[x + i], weights[i]);
  }
}

double whole_picture(const Image& a, const Image& b) {
  Moments sum;
  const double weight = 1.0 / static_cast<double>(a.pixel_count());
  for (int y = 0; y < a.height_px; ++y)
    for (int x = 0; x < a.width_px; ++x)
      add(sum, moments_of(luma(a.pixel(x, y), a.channels), luma(b.pixel(x, y), b.channels)), weight);
  return similarity(sum);
}

}  // namespace

double structural_similarity(const Image& a, const Image& b) {
  HRT_CHECK_EQ(a.width_px, b.width_px);
  HRT_CHECK_EQ(a.height_px, b.height_px);
  HRT_CHECK_EQ(a.channels, b.channels);
  if (a.width_px < kWindow_px || a.height_px < kWindow_px) return whole_picture(a, b);

  const std::array<double, kWindow_px> weights = gaussian();
  const int columns = a.width_px - kWindow_px + 1, rows = a.height_px - kWindow_px + 1;
  std::vector<Moments> pixels(a.width_px);
  std::vector<std::vector<Moments>> ring(kWindow_px, std::vector<Moments>(columns));  // of the last rows
  double sum = 0;
  for (int y = 0; y < a.height_px; ++y) {
    filter_row(a, b, y, weights, pixels, ring[y % kWindow_px]);
    if (y < kWindow_px - 1) continue;
    for (int x = 0; x < columns; ++x) {
      Moments window;
      for (int i = 0; i < kWindow_px; ++i) add(window, ring[(y + 1 + i) % kWindow_px][x], weights[i]);
      sum += similarity(window);
    }
  }
  return sum / (static_cast<double>(columns) * rows);
}

}  // namespace hybridrt
