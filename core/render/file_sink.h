#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "core/image/image.h"
#include "core/image/image_metadata.h"

namespace hybridrt {

/// The bytes of a whole file for an image that will get this name. Called from several threads at once.
using EncodeFunction =
    std::function<std::vector<unsigned char>(const Image&, const std::filesystem::path&, const ImageMetadata&)>;

/// Encodes and writes pictures on worker threads, each file whole or not at all. Memory is bounded: at most
/// `max_queued` pictures wait and one per worker is in work.
class FileSink {
 public:
  /// Gets the time that encoding and writing took, once the file stands under its final name.
  using Done = std::function<void(double write_ms)>;

  /// `workers` and `max_queued` >= 1. Throws Error usage when the system does not give so many threads.
  FileSink(EncodeFunction encode, int workers, size_t max_queued);
  /// Waits for all that was submitted. Failures nobody asked for are lost: call `drain` first.
  ~FileSink();
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;

  /// Takes the image over; blocks while the queue is full. A missing folder is made. `done` runs on a worker
  /// thread, never two at a time, only after success, and must not call the sink.
  ///
  /// Throws the first failure of an earlier picture (Error output for what the disk or the encoder refuses),
  /// once; this image is then not taken. The other pictures go on being written: a sink that threw is usable.
  void submit(std::filesystem::path path, Image image, Done done = {}, ImageMetadata metadata = {});

  /// Waits until all is written; throws as `submit`.
  void drain();

 private:
  struct Job {
    std::filesystem::path path;
    Image image;
    ImageMetadata metadata;
    Done done;
  };

  void stop();
  void work();
  void write(const Job& job);
  void rethrow_failure();  // with mutex_ held

  const EncodeFunction encode_;
  const size_t max_queued_;

  std::mutex mutex_;
  std::condition_variable job_waits_, room_, idle_;
  std::deque<Job> queue_;
  int busy_ = 0;
  bool stop_ = false;
  std::exception_ptr failure_;

  std::mutex one_done_at_a_time_;
  std::vector<std::thread> workers_;
};

}  // namespace hybridrt
