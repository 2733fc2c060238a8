#include "cli/simplify/simplify_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hybridrt::cli {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json number_or_null(double number) { return std::isfinite(number) ? Json(number) : Json(nullptr); }

Json frames_json(const std::vector<FrameDifference>& frames) {
  Json all = Json::array();
  for (const FrameDifference& frame : frames)
    all.push_back(
        {{"frame", frame.frame}, {"psnr_db", number_or_null(frame.psnr_db)}, {"outline_px", frame.outline_px}});
  return all;
}

std::string times(double before, double after) {
  return after > 0 ? fmt::format(", {:.2f} x fewer", before / after) : "";
}

std::string frames_text(const std::vector<FrameDifference>& frames) {
  const auto less = [](const FrameDifference& a, const FrameDifference& b) { return a.psnr_db < b.psnr_db; };
  const FrameDifference& worst = *std::min_element(frames.begin(), frames.end(), less);
  std::string text = std::isinf(worst.psnr_db) ? "frames      equal to the last bit of 8-bit files\n"
                                               : fmt::format("frames      PSNR at least {:.2f} dB (frame {} of {})\n",
                                                             worst.psnr_db, worst.frame, frames.size());
  int outline = 0;
  for (const FrameDifference& frame : frames) outline = std::max(outline, frame.outline_px);
  return text + fmt::format("outlines    off by at most {} px\n", outline);
}

}  // namespace

Json report_json(const SimplifyReport& r) {
  return {{"scene", r.scene},
          {"output", r.output},
          {"materials", r.materials},
          {"max_error_px", r.max_error_px},
          {"triangles_before", r.triangles_before},
          {"triangles_after", r.triangles_after},
          {"triangles_unseen", r.triangles_unseen},
          {"bytes_before", r.bytes_before ? Json(*r.bytes_before) : Json(nullptr)},
          {"bytes_after", r.bytes_after},
          {"least_bound", r.least_bound},
          {"largest_bound", r.largest_bound},
          {"hausdorff_from_original", r.distance.from_original},
          {"hausdorff_from_simplified", r.distance.from_simplified},
          {"hausdorff_px", r.distance.share * r.max_error_px},
          {"samples", r.distance.samples},
          {"rounds", r.rounds},
          {"frames", frames_json(r.frames)}};
}

std::string report_text(const SimplifyReport& r) {
  std::string text =
      fmt::format("{}: {} triangles of {}{}\n", r.output, r.triangles_after, r.triangles_before,
                  times(static_cast<double>(r.triangles_before), static_cast<double>(r.triangles_after)));
  if (r.triangles_unseen > 0) text += fmt::format("unseen      {} triangles left out\n", r.triangles_unseen);
  text += r.bytes_before ? fmt::format("bytes       {} of {}{}\n", r.bytes_after, *r.bytes_before,
                                       times(static_cast<double>(*r.bytes_before), static_cast<double>(r.bytes_after)))
                         : fmt::format("bytes       {}\n", r.bytes_after);
  text += fmt::format("bounds      {:.4g} to {:.4g} scene units\n", r.least_bound, r.largest_bound);
  text += fmt::format("Hausdorff   {:.4g} from the original, {:.4g} from the simplified, at {} samples\n",
                      r.distance.from_original, r.distance.from_simplified, r.distance.samples);
  text +=
      fmt::format("            {:.2f} px of the {:g} px allowed\n", r.distance.share * r.max_error_px, r.max_error_px);
  if (!r.frames.empty()) text += frames_text(r.frames);
  return text;
}

}  // namespace hybridrt::cli
