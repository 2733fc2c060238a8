#pragma once

#include <cstdint>

namespace hybridrt::cli {

/// From now on SIGUSR1 prints a line on standard error that says where the run is, at once and whatever it is doing;
/// without this it would end the process. Ignored signals stay ignored.
void show_status_on_signal();

/// What that line says. `doing`: a literal, as "loading the scene". `of` 0: there is nothing to count.
/// A signal handler can see nothing but what is the process's own, so this is.
void set_status(const char* doing, int64_t frames_done = 0, int64_t of = 0);

}  // namespace hybridrt::cli
