#pragma once

#include <functional>
#include <future>
#include <system_error>
#include <thread>

#include "core/base/error.h"

namespace hybridrt {

/// What to throw for a std::system_error of somebody who starts threads: Error usage, with what to do.
Error no_thread(const std::system_error& problem);

/// A thread that runs `body`. Throws no_thread() when the system gives none.
[[nodiscard]] std::thread start_thread(std::function<void()> body);

/// `body` on a thread of its own, as std::async. Throws as start_thread.
[[nodiscard]] std::future<void> start_task(std::function<void()> body);

}  // namespace hybridrt
