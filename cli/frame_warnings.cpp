#include "cli/frame_warnings.h"

#include <fmt/format.h>
#include <utility>

namespace hybridrt::cli {

std::optional<Warning> frame_warning(const Frame& frame, const RenderJob& job, FrameWarningsGiven& given) {
  if (job.settings.crop) return std::nullopt;
  if (frame.stats.pixels_hit == 0) {
    if (std::exchange(given.empty, true)) return std::nullopt;
    return Warning(
        WarningCode::frame_empty,
        fmt::format("frame {} shows nothing but background; check --eye, --target and --up-axis, or leave them out",
                    frame.number));
  }
  if (frame.stats.pixels_lit == 0 && !job.lights.lights.empty()) {
    if (std::exchange(given.dark, true)) return std::nullopt;
    return Warning(
        WarningCode::frame_dark,
        fmt::format("frame {}: no light arrives at anything in view, ambient light is all there is; check --light",
                    frame.number));
  }
  return std::nullopt;
}

}  // namespace hybridrt::cli
