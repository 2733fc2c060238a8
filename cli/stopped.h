#pragma once

#include "cli/interrupt.h"

namespace hybridrt::cli {

/// Thrown where a signal asks to stop and there is nothing to return.
struct Stopped {};

inline void stop_if_asked() {
  if (stop_requested()) throw Stopped();
}

}  // namespace hybridrt::cli
