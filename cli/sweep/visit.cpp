#include "cli/sweep/visit.h"

#include "cli/interrupt.h"
#include "cli/sweep/loaded_scene.h"
#include "cli/sweep/visit_frames.h"

namespace hybridrt::cli {

Visit measure(RenderJob& job, ThreadPool& pool) {
  const KeptJob kept{job};
  const auto count = static_cast<size_t>(kept.frames.count());
  const VisitFrames frames = frames_of_visit(kept.frames, job.settings.frames_in_flight);
  job.frames = frames.frames;
  job.settings.aovs = 0;

  Visit visit;
  size_t delivered = 0;
  const auto deliver = [&](Frame&& frame) {
    if (delivered++ == 0) {
      visit.first_frame_ms = frame.timings.wall_ms;
      visit.first_shadow_map_ms = frame.timings[PassId::shadow_map];
    }
    if (delivered <= frames.before || visit.frames.size() == count) return;
    frame.picture = {};
    visit.frames.push_back(std::move(frame));
  };
  visit.facts = run(
      job, pool, [](const RunFacts&) {}, stop_requested, deliver);
  return visit;
}

}  // namespace hybridrt::cli
