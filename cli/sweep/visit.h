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

/// Renders the job's frames for their times. The first one is rendered once before and not counted: it pays for what is
/// made once. Of several frames the last one follows it, so that the first does not find what is kept while the camera
/// stands still. Where N frames are in flight, N - 1 more come after them, so that the last one too shares the machine:
/// those that end a run leave it together. The job's AOVs are left out.
Visit measure(RenderJob& job, ThreadPool& pool);

}  // namespace hybridrt::cli
