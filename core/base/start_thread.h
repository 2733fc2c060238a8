#pragma once

#include <functional>
#include <future>
#include <system_error>
#include <thread>

#include "core/base/error.h"

namespace hybridrt {

/// The Error (usage) to throw, saying what to do, for a std::system_error met while starting a thread.
Error no_thread(const std::system_error& problem);

/// A thread that runs `body`. Throws no_thread() when the system cannot start one.
[[nodiscard]] std::thread start_thread(std::function<void()> body);

/// Runs `body` on a thread of its own, like std::async. Throws as start_thread does.
[[nodiscard]] std::future<void> start_task(std::function<void()> body);

/// Starts so many threads at once, and ends them: for libraries that hang or abort when they cannot start theirs.
/// Throws as start_thread does.
void require_threads(int count);

}  // namespace hybridrt
