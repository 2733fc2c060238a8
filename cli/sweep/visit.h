#pragma once

#include "core/render/render_job.h"

namespace hybridrt::cli {

/// One measurement of a setting: its frames, rendered once each.
struct Visit {
  double first_frame_ms = 0;  ///< the first frame with its one-off cost (light buffers, memory); rendered again after
  double first_shadow_map_ms = 0;  ///< of it, pass 1: what is kept while lights stand still
  RunFacts facts;
  std::vector<Frame> frames;  ///< without their pictures; fewer than asked for if a signal asked to stop
};

/// Renders the job's frames for their times, with those around them that frames_of_visit() says. The job's AOVs are
/// left out.
Visit measure(RenderJob& job, ThreadPool& pool);

}  // namespace hybridrt::cli
