#pragma once

#include <chrono>

namespace hybridrt {

/// Wall-clock milliseconds since construction or the last restart.
class Stopwatch {
 public:
  double elapsed_ms() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Processor time of the calling thread, in milliseconds.
double thread_cpu_ms();

}  // namespace hybridrt
