#pragma once

#include "cli/sweep/facts.h"

namespace hybridrt::cli {

struct SweepOutcome {
  size_t failed = 0;  ///< settings that could not be rendered
  bool stopped = false;
};

/// Measures what the folder does not hold yet: each scene is loaded once, settings take turns in every round, one visit
/// each. Scenes that do not fit into half of the memory limit together are measured in batches. Progress and warnings
/// go to standard error unless `quiet`. Throws Error(output), and what make_render_job() throws if there is one scene
/// only.
SweepOutcome run_sweep(const SweepRequest& request, const SweepSettings& settings, double busy, bool quiet);

}  // namespace hybridrt::cli
