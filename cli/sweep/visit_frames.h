#pragma once

#include "core/render/frame_spec.h"

namespace hybridrt::cli {

/// What a visit renders.
struct VisitFrames {
  FrameSpec frames;   ///< in order; some twice
  size_t before = 0;  ///< of them, those before the ones that count
};

/// The frames that count stand in a cycle of themselves. Before them, one for each slot, which pays for what is made
/// once: frames that fill the slots wait for each other, and then leave together. And of several frames one more, so
/// that none finds what is kept while the camera stands still. After them, one for each slot but one: those that empty
/// the slots leave together too.
VisitFrames frames_of_visit(const FrameSpec& counted, int frames_in_flight);

}  // namespace hybridrt::cli
