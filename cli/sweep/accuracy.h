#pragma once

#include "cli/sweep/truth.h"

namespace hybridrt::cli {

/// How far a frame is from its truth. Errors are those of 8-bit files of display values, 0-1.
struct Accuracy {
  double rmse = 0, psnr_db = 0, max_error = 0, ssim = 1;
  size_t pixels_different = 0;  ///< 0: equal to the last bit
  size_t pixels_off = 0;        ///< by more than 2/255 in a channel
  size_t non_finite = 0;        ///< pixels with a value that is no number; they count as black

  /// At the pixels' centres, where the frame has one sample there and the truth is known. Shadows count where both see
  /// the same triangle.
  std::optional<size_t> false_lit, false_shadow, other_triangle;
};

/// Renders the frames of `job` with what measure_accuracy() looks at: the AOVs `id` and `shadow` where there is one
/// sample a pixel. Fewer if a signal asks to stop.
std::vector<Frame> render_to_compare(RenderJob& job, ThreadPool& pool);

/// `frame` with the layers `id` and `shadow` if it has them. Throws Error(input) for a truth of another size.
Accuracy measure_accuracy(const Frame& frame, const Truth& truth);

/// Pixels that change from the frame before to this one by more than 2/255 in a channel.
struct Flicker {
  size_t true_changes = 0;   ///< in the truth
  size_t false_changes = 0;  ///< more, or less, than in the truth
};
Flicker count_flicker(const Frame& frame, const Frame& before, const Truth& truth, const Truth& truth_before);

/// The difference from the truth to look at, amplified; linear, as encode_image() takes it.
inline constexpr int kDifferenceAmplification = 8;
Image amplified_difference(const Frame& frame, const Truth& truth);

}  // namespace hybridrt::cli
