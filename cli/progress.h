#pragma once

#include <cstdint>
#include <string>

#include "core/base/timing.h"

namespace hybridrt::cli {

/// Shows on standard error how far a sequence has come: a bar that redraws itself on a terminal, else a line from time
/// to time.
class Progress {
 public:
  /// `what` is counted: "frame".
  Progress(int64_t count, bool quiet, const char* what = "frame");
  ~Progress();
  void frame_done();
  /// Prints a line without damaging the bar.
  void say(const std::string& line);

 private:
  std::string text() const;
  const int64_t frames_;
  const char* const what_;
  const bool quiet_, terminal_;
  int64_t done_ = 0;
  Stopwatch running_, since_shown_;
  bool shown_ = false;
};

}  // namespace hybridrt::cli
