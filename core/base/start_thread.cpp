#include "core/base/start_thread.h"

#include <utility>

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

}  // namespace hybridrt
