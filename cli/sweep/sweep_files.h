#pragma once

#include "cli/sweep/facts.h"
#include "core/base/run_files.h"

namespace hybridrt::cli {

/// Throws Error(usage) if one of `read` is a file that the sweep or its report writes: the rows, the facts, the page,
/// charts, what lies in DIR/pictures and DIR/truth.
void require_sweep_writes_none_of(const RunFiles& read, const SweepRequest& request);

}  // namespace hybridrt::cli
