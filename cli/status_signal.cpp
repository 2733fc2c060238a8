#include "cli/status_signal.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <unistd.h>

#include "core/base/interrupt.h"

namespace hybridrt::cli {
namespace {

// Lock-free, so that the handler may read them.
std::atomic<const char*> status_doing{"starting"};
std::atomic<int64_t> status_done{0}, status_of{0}, started_s{0};

int64_t now_s() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec;
}

/// A line of text, put together without anything that a signal handler may not call.
class Line {
 public:
  Line& operator<<(const char* text) {
    for (; *text != 0 && length_ < sizeof(text_); ++text) text_[length_++] = *text;
    return *this;
  }
  Line& operator<<(int64_t number) {
    char digits[20];
    int count = 0;
    do digits[count++] = static_cast<char>('0' + number % 10);
    while ((number /= 10) > 0);
    while (count > 0 && length_ < sizeof(text_)) text_[length_++] = digits[--count];
    return *this;
  }
  void write() const {
    if (::write(STDERR_FILENO, text_, length_) < 0) return;  // there is nobody to tell
  }

 private:
  char text_[200];
  size_t length_ = 0;
};

void print_status(int) {
  const int error_before = errno;
  Line line;
  line << "hybridrt: " << status_doing.load();
  if (const int64_t of = status_of.load()) line << ", " << status_done.load() << " of " << of << " frames are done";
  line << ", " << now_s() - started_s.load() << " s since the start\n";
  line.write();
  errno = error_before;
}

}  // namespace

void show_status_on_signal() {
  started_s = now_s();
  handle_signal(SIGUSR1, print_status);
}

void set_status(const char* doing, int64_t frames_done, int64_t of) {
  status_doing = doing, status_done = frames_done, status_of = of;
}

}  // namespace hybridrt::cli
