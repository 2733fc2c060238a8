#include "cli/sweep/visit_frames.h"

namespace hybridrt::cli {

VisitFrames frames_of_visit(const FrameSpec& counted, int frames_in_flight) {
  const FrameRange& first = counted.ranges.front();
  const FrameRange& last = counted.ranges.back();
  const int last_frame = last.first + (last.last - last.first) / last.step * last.step;
  VisitFrames visit;
  std::vector<FrameRange>& ranges = visit.frames.ranges;
  ranges.assign(static_cast<size_t>(frames_in_flight), {first.first, first.first, 1});
  if (counted.count() > 1) ranges.push_back({last_frame, last_frame, 1});
  visit.before = ranges.size();
  ranges.insert(ranges.end(), counted.ranges.begin(), counted.ranges.end());
  ranges.insert(ranges.end(), static_cast<size_t>(frames_in_flight - 1), {last_frame, last_frame, 1});
  return visit;
}

}  // namespace hybridrt::cli
