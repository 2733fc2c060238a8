#include "core/render/file_sink.h"

#include <span>
#include <utility>

#include "core/base/check.h"
#include "core/base/output_file.h"
#include "core/base/start_thread.h"
#include "core/base/timing.h"
#include "core/render/picture_record.h"

namespace hybridrt {
namespace fs = std::filesystem;

FileSink::FileSink(EncodeFunction encode, int workers, size_t max_queued)
    : encode_(std::move(encode)), max_queued_(max_queued) {
  HRT_CHECK(encode_ && workers >= 1 && max_queued >= 1);
  workers_.reserve(static_cast<size_t>(workers));
  try {
    for (int i = 0; i < workers; ++i) workers_.push_back(start_thread([this] { work(); }));
  } catch (...) {
    stop();
    throw;
  }
}

FileSink::~FileSink() { stop(); }

void FileSink::stop() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;  // workers end only when the queue is empty
  }
  job_waits_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void FileSink::submit(fs::path path, Image image, Done done, ImageMetadata metadata, bool with_record) {
  {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return queue_.size() < max_queued_ || failure_; });
    rethrow_failure();
    queue_.push_back({std::move(path), std::move(image), std::move(metadata), std::move(done), with_record});
  }
  job_waits_.notify_one();
}

void FileSink::drain() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] { return queue_.empty() && busy_ == 0; });
  rethrow_failure();
}

void FileSink::rethrow_failure() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void FileSink::work() {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      job_waits_.wait(lock, [this] { return stop_ || !queue_.empty(); });
      if (queue_.empty()) return;
      job = std::move(queue_.front());
      queue_.pop_front();
      ++busy_;
    }
    room_.notify_one();

    std::exception_ptr failure;
    try {
      write(job);
    } catch (...) {
      failure = std::current_exception();
    }
    job = {};  // before the wait for the next one: an image may be large

    std::lock_guard lock(mutex_);
    if (failure && !failure_) failure_ = std::move(failure);  // leaves no owner here that outlives the catcher
    if (failure_) room_.notify_all();
    if (--busy_ == 0 && queue_.empty()) idle_.notify_all();
  }
}

void FileSink::write(const Job& job) {
  const Stopwatch stopwatch;
  const std::vector<unsigned char> bytes = encode_(job.image, job.path, job.metadata);
  std::error_code missing;
  if (job.with_record) fs::remove(record_path(job.path), missing);
  write_file_atomically(job.path, std::as_bytes(std::span(bytes)));
  if (job.with_record)
    write_file_atomically(record_path(job.path),
                          record_text(description_of(job.metadata), std::as_bytes(std::span(bytes))));
  if (!job.done) return;
  const double write_ms = stopwatch.elapsed_ms();
  std::lock_guard lock(one_done_at_a_time_);
  job.done(write_ms);
}

}  // namespace hybridrt
