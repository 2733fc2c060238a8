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

/// Encodes an image as the bytes of a file of this name. Called from several threads at once.
using EncodeFunction =
    std::function<std::vector<unsigned char>(const Image&, const std::filesystem::path&, const ImageMetadata&)>;

/// Encodes pictures and writes them atomically, on worker threads. Memory is bounded: at most `max_queued` pictures
/// wait, and each worker holds one.
class FileSink {
 public:
  /// Gets the time that encoding and writing took, once the file has its final name.
  using Done = std::function<void(double write_ms)>;

  /// `workers` and `max_queued` >= 1. Throws Error (usage) when the system cannot start that many threads.
  FileSink(EncodeFunction encode, int workers, size_t max_queued);
  /// Waits for all submitted pictures. Failures that were not thrown yet are lost: call `drain` first.
  ~FileSink();
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;

  /// Takes the image over; blocks while the queue is full. A missing folder is created. `done` runs on a worker thread,
  /// one at a time, only after success, and must not call the sink.
  ///
  /// Throws the first failure of an earlier picture once (Error (output) from the disk or the encoder); this image is
  /// then not taken. The other pictures are still written, and the sink stays usable.
  ///
  /// `with_record`: the metadata also go into a record beside the picture (picture_record.h), written after it; an old
  /// one is removed before.
  void submit(std::filesystem::path path, Image image, Done done = {}, ImageMetadata metadata = {},
              bool with_record = false);

  /// Waits until all pictures are written; throws as `submit`.
  void drain();

 private:
  struct Job {
    std::filesystem::path path;
    Image image;
    ImageMetadata metadata;
    Done done;
    bool with_record = false;
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
