#include "cli/sweep/visit_frames.h"

namespace hybridrt::cli {
namespace {

/// `place` counts from 0 in the order of the frames.
int frame_at(const FrameSpec& spec, int64_t place) {
  for (const FrameRange& range : spec.ranges) {
    const int64_t count = FrameSpec{{range}}.count();
    if (place < count) return static_cast<int>(range.first + place * range.step);
    place -= count;
  }
  return spec.ranges.back().last;
}

}  // namespace

VisitFrames frames_of_visit(const FrameSpec& counted, int frames_in_flight) {
  const int64_t count = counted.count(), before = count > 1 ? frames_in_flight + 1 : frames_in_flight;
  VisitFrames visit;
  std::vector<FrameRange>& ranges = visit.frames.ranges;
  ranges.clear();
  const auto add = [&](int64_t place_in_cycle) {
    const int frame = frame_at(counted, place_in_cycle % count);
    ranges.push_back({frame, frame, 1});
  };
  for (int64_t i = before; i > 0; --i) add(count - 1 - (i - 1) % count);
  visit.before = ranges.size();
  ranges.insert(ranges.end(), counted.ranges.begin(), counted.ranges.end());
  for (int64_t i = 0; i + 1 < frames_in_flight; ++i) add(i);
  return visit;
}

}  // namespace hybridrt::cli
