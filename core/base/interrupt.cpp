#include "core/base/interrupt.h"

#include <csignal>
#include <unistd.h>

#include "core/base/temporary_names.h"

namespace hybridrt {
namespace {

// The only type through which a signal handler and the program may tell each other something.
volatile std::sig_atomic_t first_signal = 0, finishing_frames = 0;

void handle(int signal) {
  if (signal == SIGHUP) signal = SIGTERM;
  if (first_signal || !finishing_frames) {
    remove_temporary_files();
    _exit(128 + signal);
  }
  first_signal = signal;
}

}  // namespace

void catch_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = handle;
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
  }
}

FinishingFrames::FinishingFrames() { finishing_frames = finishing_frames + 1; }
FinishingFrames::~FinishingFrames() { finishing_frames = finishing_frames - 1; }

bool stop_requested() { return first_signal != 0; }

int stopping_signal() { return first_signal; }

}  // namespace hybridrt
