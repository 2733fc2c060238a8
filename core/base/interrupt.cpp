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

void handle_signal(int signal, void (*handler)(int)) {
  struct sigaction before {};
  if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  ::sigaction(signal, &action, nullptr);
}

void catch_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle_signal(signal, handle);
}

FinishingFrames::FinishingFrames() { finishing_frames = finishing_frames + 1; }
FinishingFrames::~FinishingFrames() { finishing_frames = finishing_frames - 1; }

bool stop_requested() { return first_signal != 0; }

int stopping_signal() { return first_signal; }

}  // namespace hybridrt
