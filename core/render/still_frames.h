#pragma once

#include "core/render/frame.h"

namespace hybridrt {

/// Whether both show the same, whatever their numbers.
bool shows_the_same(const FrameRequest& a, const FrameRequest& b);

/// The two ends of a renderer that renders a frame once however often it follows itself: `next` leaves out requests
/// that show the same as the one before; `deliver` repeats that one's frame under their numbers, with
/// Frame::repeated, no times and no rays. Both belong to one run, and are called from one thread.
struct FrameEnds {
  NextFrame next;
  DeliverFrame deliver;
};
[[nodiscard]] FrameEnds without_repeats(NextFrame next, DeliverFrame deliver);

}  // namespace hybridrt
