#include "cli/progress.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unistd.h>

#include "cli/standard_streams.h"

namespace hybridrt::cli {
namespace {

constexpr double kRedraw_ms = 100, kLine_ms = 10'000;
constexpr int kBarWidth = 30;

std::string duration(double seconds) {
  const auto s = static_cast<long long>(std::ceil(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
  return fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

}  // namespace

Progress::Progress(int64_t count, bool quiet, const char* what)
    : frames_(count), what_(what), quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {}

Progress::~Progress() {
  if (shown_ && terminal_) cli::say("\n");
}

std::string Progress::text() const {
  const double seconds = running_.elapsed_ms() * 1e-3;
  const double rate = static_cast<double>(done_) / std::max(seconds, 1e-9);
  const std::string left =
      done_ < frames_ ? duration(static_cast<double>(frames_ - done_) / rate) + " left" : "in " + duration(seconds);
  const std::string fast = rate >= 0.1 ? fmt::format("  {:.2f} {}s/s", rate, what_) : "";
  return fmt::format("{} {}/{}{}  {}", what_, done_, frames_, fast, left);
}

void Progress::frame_done() {
  ++done_;
  if (quiet_) return;
  const bool last = done_ == frames_;
  if (!last && shown_ && since_shown_.elapsed_ms() < (terminal_ ? kRedraw_ms : kLine_ms)) return;
  if (terminal_) {
    const int filled = static_cast<int>(kBarWidth * done_ / std::max<int64_t>(frames_, 1));
    cli::say(fmt::format("\r[{:#<{}}{:.<{}}] {}\x1b[K", "", filled, "", kBarWidth - filled, text()));
  } else {
    cli::say(text() + "\n");
  }
  shown_ = true;
  since_shown_.restart();
}

void Progress::say(const std::string& line) {
  cli::say(fmt::format("{}{}\n", terminal_ && shown_ ? "\r\x1b[K" : "", line));
}

}  // namespace hybridrt::cli
