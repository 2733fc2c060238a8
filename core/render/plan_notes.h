#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/render/frame_plan.h"

namespace hybridrt {

enum class Runs { never, once, each_frame };
std::string_view name_of(Runs runs);

/// Whether a step of a frame runs, and why, in words.
struct StepNote {
  std::string_view step;
  Runs runs = Runs::each_frame;
  std::string why;
};

/// The steps of the frame that `plan` is for, in order, including those left out. `plan` and `facts` must belong to the
/// same settings.
std::vector<StepNote> explain_plan(const FramePlan& plan, const SceneFacts& facts, const RenderSettings& settings,
                                   bool light_moves);

}  // namespace hybridrt
