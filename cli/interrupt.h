#pragma once

#include "cli/exit_codes.h"
#include "core/base/interrupt.h"

namespace hybridrt::cli {

/// 130 or 143 if stop_requested(), else `otherwise`.
ExitCode interrupted_or(ExitCode otherwise);

}  // namespace hybridrt::cli
