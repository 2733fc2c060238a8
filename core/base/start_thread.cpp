#include "core/base/start_thread.h"

#include <utility>
#include <vector>

namespace hybridrt {

Error no_thread(const std::system_error& problem) {
  return error(ErrorKind::usage,
               "no more threads can be started: {}; give --threads a smaller number, or raise the limits of processes "
               "and memory",
               problem.code().message());
}

std::thread start_thread(std::function<void()> body) try {
  return std::thread(std::move(body));
} catch (const std::system_error& problem) {
  throw no_thread(problem);
}

std::future<void> start_task(std::function<void()> body) try {
  return std::async(std::launch::async, std::move(body));
} catch (const std::system_error& problem) {
  throw no_thread(problem);
}

void require_threads(int count) {
  std::promise<void> all_are_there;
  const std::shared_future<void> end = all_are_there.get_future().share();
  std::vector<std::future<void>> threads;
  try {
    for (int i = 0; i < count; ++i) threads.push_back(start_task([end] { end.wait(); }));
  } catch (...) {
    all_are_there.set_value();
    throw;
  }
  all_are_there.set_value();
}

}  // namespace hybridrt
