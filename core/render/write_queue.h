#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hybridrt {

/// Work on pictures that have been rendered, done by threads of its own while others are rendered. It is bounded by
/// the memory that the work holds, waiting or in progress; one worker does it in the order in which it came.
class WriteQueue {
 public:
  /// `workers` >= 1. Throws Error (usage) when the system cannot start that many threads.
  WriteQueue(int workers, size_t most_bytes);
  /// Waits for all work. Failures that were not thrown yet are lost: call `drain` first.
  ~WriteQueue();
  WriteQueue(const WriteQueue&) = delete;
  WriteQueue& operator=(const WriteQueue&) = delete;

  /// Takes over work that holds `bytes`; blocks while all that there is would hold more than allowed. What alone holds
  /// more waits until there is nothing else. Throws the first failure of earlier work once; `work` is then not taken.
  /// The other work is still done, and the queue stays usable.
  void submit(size_t bytes, std::function<void()> work);

  /// Waits until all is done; throws as `submit`.
  void drain();

 private:
  struct Job {
    size_t bytes = 0;
    std::function<void()> work;
  };

  void stop();
  void run();
  void rethrow_failure();  // with mutex_ held

  const size_t most_bytes_;
  std::mutex mutex_;
  std::condition_variable job_waits_, room_;
  std::deque<Job> waiting_;
  size_t held_bytes_ = 0;
  int jobs_ = 0;  ///< waiting and in progress
  bool stop_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> workers_;
};

}  // namespace hybridrt
