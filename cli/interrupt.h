#pragma once

#include "cli/exit_codes.h"

namespace hybridrt::cli {

/// From now on the first SIGINT or SIGTERM asks to stop after the frames in progress; a second one ends the process at
/// once.
void catch_signals();

/// True once a signal has arrived.
bool stop_requested();

/// 130 or 143 if stop_requested(), else `otherwise`.
ExitCode interrupted_or(ExitCode otherwise);

}  // namespace hybridrt::cli
