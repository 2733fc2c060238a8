#pragma once

#include <optional>

#include "core/base/warnings.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// Which of a run's warnings about frames have been given: each is given once.
struct FrameWarningsGiven {
  bool empty = false, dark = false;
};

/// A warning for a frame that shows nothing, or in which no light arrives anywhere although there are lights; none for
/// crops, which may well do so.
std::optional<Warning> frame_warning(const Frame& frame, const RenderJob& job, FrameWarningsGiven& given);

}  // namespace hybridrt::cli
