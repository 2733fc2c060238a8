#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hybridrt {

/// Processors that this process may use: its affinity mask, further limited by the cgroup's CPU quota (version 1 or 2),
/// rounded up; at least 1.
int allowed_processors();

/// A fixed set of worker threads for loops over independent chunks. The calling thread works too, so a pool of size 1
/// starts no thread. Which worker takes which chunk varies from run to run: results must not depend on it.
class ThreadPool {
 public:
  /// `threads` >= 1, the caller's own included. Throws Error (usage) when the system cannot start that many.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls `body(chunk, worker)` once for each chunk in [0, chunks), worker in [0, size()). Returns when all are done;
  /// rethrows the first exception (the remaining chunks are then skipped). May be called from any thread but not from
  /// inside a body; concurrent calls run one after the other.
  void run(size_t chunks, const std::function<void(size_t chunk, int worker)>& body);

 private:
  void stop();
  void work(int worker);
  void take_chunks(int worker);

  std::vector<std::thread> workers_;
  std::mutex one_run_at_a_time_;

  std::mutex mutex_;
  std::condition_variable start_, done_;
  const std::function<void(size_t, int)>* body_ = nullptr;
  size_t chunks_ = 0, next_chunk_ = 0;
  uint64_t generation_ = 0;
  int busy_ = 0;
  bool stop_ = false;
  std::exception_ptr failure_;
};

/// `body(begin, end)` over consecutive ranges of at most `grain` items. The partition depends on
/// `count` and `grain` only, never on the number of threads.
template <typename Body>
void parallel_for(ThreadPool& pool, size_t count, size_t grain, const Body& body) {
  const size_t chunks = (count + grain - 1) / grain;
  pool.run(chunks, [&](size_t chunk, int) { body(chunk * grain, std::min(count, (chunk + 1) * grain)); });
}

}  // namespace hybridrt
