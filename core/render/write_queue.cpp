#include "core/render/write_queue.h"

#include <utility>

#include "core/base/check.h"
#include "core/base/start_thread.h"

namespace hybridrt {

WriteQueue::WriteQueue(int workers, size_t most_bytes) : most_bytes_(most_bytes) {
  HRT_CHECK(workers >= 1);
  workers_.reserve(static_cast<size_t>(workers));
  try {
    for (int i = 0; i < workers; ++i) workers_.push_back(start_thread([this] { run(); }));
  } catch (...) {
    stop();
    throw;
  }
}

WriteQueue::~WriteQueue() { stop(); }

void WriteQueue::stop() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;  // workers end only when nothing waits
  }
  job_waits_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WriteQueue::submit(size_t bytes, std::function<void()> work) {
  {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return jobs_ == 0 || held_bytes_ + bytes <= most_bytes_ || failure_; });
    rethrow_failure();
    waiting_.push_back({bytes, std::move(work)});
    held_bytes_ += bytes;
    ++jobs_;
  }
  job_waits_.notify_one();
}

void WriteQueue::drain() {
  std::unique_lock lock(mutex_);
  room_.wait(lock, [this] { return jobs_ == 0; });
  rethrow_failure();
}

void WriteQueue::rethrow_failure() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void WriteQueue::run() {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      job_waits_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      job = std::move(waiting_.front());
      waiting_.pop_front();
    }

    std::exception_ptr failure;
    try {
      job.work();
    } catch (...) {
      failure = std::current_exception();
    }
    job.work = {};  // with the picture, before anyone is told that there is room

    std::lock_guard lock(mutex_);
    if (failure && !failure_) failure_ = std::move(failure);  // leaves no owner here that outlives the catcher
    held_bytes_ -= job.bytes;
    --jobs_;
    room_.notify_all();
  }
}

}  // namespace hybridrt
