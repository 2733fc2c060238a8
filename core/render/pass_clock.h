#pragma once

#include <array>
#include <numeric>

#include "core/base/timing.h"
#include "core/render/frame_timings.h"

namespace hybridrt {

/// Milliseconds of one thread, by PassId.
using PassTimes = std::array<double, static_cast<size_t>(PassId::count)>;

/// Adds the time since the last call to a pass.
class PassClock {
 public:
  explicit PassClock(PassTimes& times_ms) : times_ms_(times_ms) {}
  /// Returns what it adds.
  double charge(PassId pass) {
    const double ms = watch_.elapsed_ms();
    times_ms_[static_cast<size_t>(pass)] += ms;
    watch_.restart();
    return ms;
  }

 private:
  PassTimes& times_ms_;
  Stopwatch watch_;
};

/// Adds the threads' time of each pass, and that time shared out over the wall time that they took together.
inline void add_threads_times(FrameTimings& timings, const PassTimes& threads_ms, double wall_ms) {
  const double sum = std::accumulate(threads_ms.begin(), threads_ms.end(), 0.0);
  if (sum <= 0) return;
  for (size_t pass = 0; pass < threads_ms.size(); ++pass) {
    timings.threads_ms[pass] += threads_ms[pass];
    timings.pass_ms[pass] += threads_ms[pass] / sum * wall_ms;
  }
}

}  // namespace hybridrt
