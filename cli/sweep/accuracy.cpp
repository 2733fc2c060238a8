#include "cli/sweep/accuracy.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/image/compare.h"
#include "core/image/srgb.h"
#include "core/image/ssim.h"

namespace hybridrt::cli {
namespace {

constexpr double kOff = 2.5 / 255;  // between two and three codes

size_t count_non_finite(const Image& picture) {
  size_t count = 0;
  for (size_t first = 0; first < picture.data.size(); first += picture.channels)
    count += std::any_of(&picture.data[first], &picture.data[first] + picture.channels,
                         [](float v) { return !std::isfinite(v); });
  return count;
}

const ImageLayer* layer_of(const Frame& frame, std::string_view name) {
  const auto found =
      std::find_if(frame.aovs.begin(), frame.aovs.end(), [&](const ImageLayer& l) { return l.name == name; });
  return found == frame.aovs.end() ? nullptr : &*found;
}

void compare_centres(const Frame& frame, const Truth& truth, Accuracy& accuracy) {
  const ImageLayer *ids = layer_of(frame, "id"), *shadow = layer_of(frame, "shadow");
  if (!ids || truth.ids.empty()) return;
  accuracy.other_triangle = 0;
  if (shadow) accuracy.false_lit = accuracy.false_shadow = 0;
  for (size_t i = 0; i < truth.ids.size(); ++i) {
    if (ids->numbers[i] != truth.ids[i]) {
      ++*accuracy.other_triangle;
    } else if (shadow) {
      *accuracy.false_lit += shadow->values[i] > truth.shadow[i];
      *accuracy.false_shadow += shadow->values[i] < truth.shadow[i];
    }
  }
}

}  // namespace

std::vector<Frame> render_to_compare(RenderJob& job, ThreadPool& pool) {
  RenderSettings settings = job.settings;
  settings.aovs = 0;
  if (settings.samples == 1) settings.aovs |= kAovId;
  if (settings.samples == 1 && settings.shadows != ShadowMode::none) settings.aovs |= kAovShadow;
  return render_frames(job, settings, pool);
}

Accuracy measure_accuracy(const Frame& frame, const Truth& truth) {
  const Image shown = displayed(frame.picture);
  const CompareResult compared = compare_images(shown, truth.picture, {.fail = 0, .hard_fail = kOff});
  if (!compared.measured)
    throw error(ErrorKind::input, "{} cannot be the truth of frame {}: {}", truth.file.string(), frame.number,
                compared.reason);
  Accuracy accuracy;
  accuracy.rmse = compared.rmse;
  accuracy.psnr_db = compared.psnr_db;
  accuracy.max_error = compared.max_error;
  accuracy.ssim = structural_similarity(shown, truth.picture);
  accuracy.pixels_different = compared.pixels_over_fail;
  accuracy.pixels_off = compared.pixels_over_hard_fail;
  accuracy.non_finite = count_non_finite(frame.picture);
  compare_centres(frame, truth, accuracy);
  return accuracy;
}

Flicker count_flicker(const Frame& frame, const Frame& before, const Truth& truth, const Truth& truth_before) {
  const Image shown = displayed(frame.picture), shown_before = displayed(before.picture);
  const auto channels = static_cast<size_t>(shown.channels);
  Flicker flicker;
  for (size_t pixel = 0; pixel < shown.pixel_count(); ++pixel) {
    bool changes = false, differs = false;
    for (size_t i = channels * pixel; i < channels * (pixel + 1); ++i) {
      const double change = double{shown.data[i]} - shown_before.data[i];
      const double true_change = double{truth.picture.data[i]} - truth_before.picture.data[i];
      changes = changes || std::abs(true_change) > kOff;
      differs = differs || std::abs(change - true_change) > kOff;
    }
    flicker.true_changes += changes;
    flicker.false_changes += differs;
  }
  return flicker;
}

Image amplified_difference(const Frame& frame, const Truth& truth) {
  return linear_from_srgb(difference_image(displayed(frame.picture), truth.picture, kDifferenceAmplification));
}

}  // namespace hybridrt::cli
