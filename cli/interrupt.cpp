#include "cli/interrupt.h"

#include <csignal>
#include <unistd.h>

namespace hybridrt::cli {
namespace {

// The only type through which a signal handler may tell the program something.
volatile std::sig_atomic_t first_signal = 0;

void handle(int signal) {
  if (first_signal) _exit(128 + signal);
  first_signal = signal;
}

}  // namespace

void catch_signals() {
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

bool stop_requested() { return first_signal != 0; }

ExitCode interrupted_or(ExitCode otherwise) {
  if (!stop_requested()) return otherwise;
  return first_signal == SIGINT ? ExitCode::interrupted : ExitCode::terminated;
}

}  // namespace hybridrt::cli
