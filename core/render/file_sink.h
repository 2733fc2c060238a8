#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <vector>

#include "core/image/image.h"
#include "core/image/image_metadata.h"
#include "core/render/write_queue.h"

namespace hybridrt {

/// Encodes an image as the bytes of a file of this name. Called from several threads at once.
using EncodeFunction =
    std::function<std::vector<unsigned char>(const Image&, const std::filesystem::path&, const ImageMetadata&)>;

/// Encodes pictures and writes them atomically, on worker threads. Memory is bounded: pictures that wait or are being
/// written hold at most `most_bytes`, or there is only one.
class FileSink {
 public:
  /// Gets the time that encoding and writing took, once the file has its final name.
  using Done = std::function<void(double write_ms)>;

  /// As WriteQueue (write_queue.h).
  FileSink(EncodeFunction encode, int workers, size_t most_bytes);

  /// Takes the image over; blocks while there is no room. A missing folder is created. `done` runs on a worker thread,
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
  void drain() { queue_.drain(); }

 private:
  struct Job {
    std::filesystem::path path;
    Image image;
    ImageMetadata metadata;
    Done done;
    bool with_record = false;
  };

  void write(const Job& job);

  const EncodeFunction encode_;
  std::mutex one_done_at_a_time_;
  WriteQueue queue_;  ///< last, since its threads use the others
};

}  // namespace hybridrt
