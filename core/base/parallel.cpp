#include "core/base/parallel.h"

#include <cmath>
#include <fstream>
#include <sched.h>
#include <string>

#include "core/base/check.h"
#include "core/base/start_thread.h"

namespace hybridrt {
namespace {

/// The cgroup's CPU quota in processors, or 0 where there is none.
double cgroup_quota_processors() {
  double quota_us = 0, period_us = 0;
  if (std::ifstream v2("/sys/fs/cgroup/cpu.max"); v2) {
    std::string quota;
    if (v2 >> quota >> period_us && quota != "max") quota_us = std::strtod(quota.c_str(), nullptr);
  } else {
    std::ifstream v1_quota("/sys/fs/cgroup/cpu/cpu.cfs_quota_us");
    std::ifstream v1_period("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
    v1_quota >> quota_us;
    v1_period >> period_us;
  }
  return quota_us > 0 && period_us > 0 ? quota_us / period_us : 0;
}

}  // namespace

int allowed_processors() {
  int processors = static_cast<int>(std::thread::hardware_concurrency());
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) processors = CPU_COUNT(&set);
  const double quota = cgroup_quota_processors();
  if (quota > 0) processors = std::min(processors, static_cast<int>(std::ceil(quota)));
  return std::max(1, processors);
}

ThreadPool::ThreadPool(int threads) {
  HRT_CHECK(threads >= 1);
  workers_.reserve(static_cast<size_t>(threads));
  try {
    for (int worker = 1; worker < threads; ++worker) workers_.push_back(start_thread([this, worker] { work(worker); }));
  } catch (...) {
    stop();
    throw;
  }
}

ThreadPool::~ThreadPool() { stop(); }

void ThreadPool::stop() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::run(size_t chunks, const std::function<void(size_t, int)>& body) {
  std::lock_guard one(one_run_at_a_time_);
  {
    std::lock_guard lock(mutex_);
    body_ = &body;
    chunks_ = chunks;
    next_chunk_ = 0;
    failure_ = nullptr;
    busy_ = static_cast<int>(workers_.size());
    ++generation_;
  }
  start_.notify_all();
  take_chunks(0);

  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
  body_ = nullptr;
  if (failure_) std::rethrow_exception(failure_);
}

void ThreadPool::work(int worker) {
  uint64_t seen = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [&] { return stop_ || generation_ != seen; });
      if (stop_) return;
      seen = generation_;
    }
    take_chunks(worker);
    std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

void ThreadPool::take_chunks(int worker) {
  for (;;) {
    size_t chunk;
    {
      std::lock_guard lock(mutex_);
      if (next_chunk_ >= chunks_) return;
      chunk = next_chunk_++;
    }
    try {
      (*body_)(chunk, worker);
    } catch (...) {
      std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      next_chunk_ = chunks_;
    }
  }
}

}  // namespace hybridrt
