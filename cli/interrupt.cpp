#include "cli/interrupt.h"

#include <csignal>

namespace hybridrt::cli {

ExitCode interrupted_or(ExitCode otherwise) {
  if (!stop_requested()) return otherwise;
  return stopping_signal() == SIGINT ? ExitCode::interrupted : ExitCode::terminated;
}

}  // namespace hybridrt::cli
