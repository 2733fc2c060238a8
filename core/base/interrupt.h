#pragma once

namespace hybridrt {

/// `handler` from now on, unless the caller of the program had it ignore the signal. Waits in the system go on after
/// it.
void handle_signal(int signal, void (*handler)(int));

/// From now on a SIGINT, SIGTERM or SIGHUP ends the process at once, with the exit code of the signal (SIGHUP: as
/// SIGTERM) and without temporary files; while frames are being finished (FinishingFrames) only the second one does.
/// Signals that the caller had the program ignore stay ignored (nohup). Signals are the process's, and so is this.
void catch_signals();

/// While one lives, the first signal asks to stop after the frames in progress: stop_requested(). For the main thread.
class FinishingFrames {
 public:
  FinishingFrames();
  ~FinishingFrames();
  FinishingFrames(const FinishingFrames&) = delete;
  FinishingFrames& operator=(const FinishingFrames&) = delete;
};

/// True once a signal has asked to stop.
bool stop_requested();

/// The signal that did; 0 if none.
int stopping_signal();

}  // namespace hybridrt
