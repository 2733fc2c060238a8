#include "cli/sweep/visit.h"

#include "cli/interrupt.h"
#include "cli/sweep/loaded_scene.h"

namespace hybridrt::cli {

Visit measure(RenderJob& job, ThreadPool& pool) {
  const KeptJob kept{job};
  const auto count = static_cast<size_t>(kept.frames.count());
  const FrameRange& first = kept.frames.ranges.front();
  const FrameRange& last = kept.frames.ranges.back();
  const int last_frame = last.first + (last.last - last.first) / last.step * last.step;
  std::vector<FrameRange> before = {{first.first, first.first, 1}};
  if (count > 1) before.push_back({last_frame, last_frame, 1});
  job.frames.ranges.insert(job.frames.ranges.begin(), before.begin(), before.end());
  job.frames.ranges.insert(job.frames.ranges.end(), static_cast<size_t>(job.settings.frames_in_flight - 1),
                           {last_frame, last_frame, 1});
  job.settings.aovs = 0;

  Visit visit;
  size_t delivered = 0;
  const auto deliver = [&](Frame&& frame) {
    if (delivered++ == 0) {
      visit.first_frame_ms = frame.timings.wall_ms;
      visit.first_shadow_map_ms = frame.timings[PassId::shadow_map];
    }
    if (delivered <= before.size() || visit.frames.size() == count) return;
    frame.picture = {};
    visit.frames.push_back(std::move(frame));
  };
  visit.facts = run(
      job, pool, [](const RunFacts&) {}, stop_requested, deliver);
  return visit;
}

}  // namespace hybridrt::cli
