#include "cli/sweep/machine_load.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

#include "cli/interrupt.h"
#include "core/base/timing.h"

namespace hybridrt::cli {
namespace {

struct Ticks {
  double busy = 0, all = 0, ours = 0;  ///< of one processor's clock
};

double own_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The first line of /proc/stat: user, nice, system, idle, iowait, irq, softirq, steal.
std::optional<Ticks> read_ticks() {
  std::ifstream file("/proc/stat");
  std::string word;
  if (!(file >> word) || word != "cpu") return std::nullopt;
  Ticks ticks;
  for (int column = 0; column < 8; ++column) {
    double value = 0;
    if (!(file >> value)) return std::nullopt;
    ticks.all += value;
    if (column != 3 && column != 4) ticks.busy += value;
  }
  ticks.ours = own_seconds() * static_cast<double>(sysconf(_SC_CLK_TCK));
  return ticks;
}

}  // namespace

double share_of_others(double watch_ms) {
  const std::optional<Ticks> before = read_ticks();
  std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(watch_ms));
  const std::optional<Ticks> after = read_ticks();
  if (!before || !after || after->all <= before->all) return 0;
  const double others = (after->busy - before->busy) - (after->ours - before->ours);
  return std::clamp(others / (after->all - before->all), 0.0, 1.0);
}

double wait_until_quiet(double quiet, double longest_s) {
  const Stopwatch waiting;
  double share = share_of_others(500);
  while (share >= quiet && waiting.elapsed_ms() < longest_s * 1e3 && !stop_requested()) share = share_of_others(1000);
  return share;
}

}  // namespace hybridrt::cli
