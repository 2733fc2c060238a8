#pragma once

#include "cli/tune/trials.h"

namespace hybridrt::cli {

/// The cheapest choice found that meets the goal. Errors of samples, depth and shadows hardly depend on each other, so
/// they are settled one after the other, from the best that there is: as few samples as the goal allows, then as few
/// generations of rays; then every method and shadow mode that meets the goal so, with its own parameters (map and
/// kernel) as small as it allows, is timed; then accelerator and frames in flight of the fastest. Throws Error(usage),
/// saying what can be reached, if the best does not meet the goal.
Choice cheapest_choice(Trials& trials, const Goal& goal);

}  // namespace hybridrt::cli
