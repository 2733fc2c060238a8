#include "cli/sweep/visit_frames.h"

#include <algorithm>
#include <optional>

namespace hybridrt::cli {

VisitFrames frames_of_visit(const FrameSpec& counted, int frames_in_flight) {
  std::vector<int> numbers;
  FrameCursor cursor(counted);
  while (const std::optional<int> frame = cursor.next()) numbers.push_back(*frame);
  const size_t count = numbers.size(), in_flight = static_cast<size_t>(frames_in_flight);
  VisitFrames visit;
  visit.frames.ranges.clear();
  const auto add = [&](size_t place) {
    const int frame = numbers[place % count];
    visit.frames.ranges.push_back({frame, frame, 1});
  };
  visit.before = count > 1 ? in_flight + 1 : in_flight;
  const size_t whole_cycles = visit.before / count + 1;
  for (size_t i = 0; i < visit.before; ++i) add(whole_cycles * count - visit.before + i);
  visit.frames.ranges.insert(visit.frames.ranges.end(), counted.ranges.begin(), counted.ranges.end());
  for (size_t i = 0; i + 1 < in_flight; ++i) add(i);
  return visit;
}

}  // namespace hybridrt::cli
