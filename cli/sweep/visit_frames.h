#pragma once

#include "core/render/frame_spec.h"

namespace hybridrt::cli {

/// What a visit renders.
struct VisitFrames {
  FrameSpec frames;   ///< in order; some twice
  size_t before = 0;  ///< of them, those before the ones that count
};

/// Before the frames that count the first of them, which pays for what is made once, as often as there are frames in
/// flight: those that fill the slots wait for each other, and then leave together. And of several frames the last one,
/// so that the first does not find what is kept while the camera stands still. After them the last one again, as
/// often as there are frames in flight beside one: those that end a run leave it together, and have no neighbours.
VisitFrames frames_of_visit(const FrameSpec& counted, int frames_in_flight);

}  // namespace hybridrt::cli
