#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/base/output_file.h"
#include "core/image/image.h"
#include "core/image/image_metadata.h"
#include "core/image_io/encode_options.h"
#include "core/image_io/video_frame.h"
#include "core/render/write_queue.h"

namespace hybridrt::cli {

/// Where pictures go that become no files: standard output, a descriptor, a pipe or a device.
struct StreamTarget {
  std::string name;                  ///< "-" is standard output; empty: none
  std::optional<VideoFormat> video;  ///< else each picture is a PNG
  FrameRate rate;
};

/// Pictures of equal size one after the other into a stream, in the order in which they come, by a thread of its own. A
/// reader that is slow fills the queue, and then submit() waits.
class PictureStream {
 public:
  /// `most_bytes`: what waiting pictures may hold. Opens nothing yet.
  PictureStream(StreamTarget target, const EncodeOptions& encode, size_t most_bytes)
      : target_(std::move(target)), encode_(encode), queue_(1, most_bytes) {}

  /// `done` gets the milliseconds that encoding and writing took, waiting for the reader included; on the other thread.
  /// Throws Error (output) once if an earlier picture could not be written, for example as the reader is gone.
  void submit(Image picture, ImageMetadata metadata, std::function<void(double write_ms)> done);

  /// Waits until everything is written; throws as submit().
  void finish();

 private:
  void write(const Image& picture, const ImageMetadata& metadata);
  void open(const Image& first);

  const StreamTarget target_;
  const EncodeOptions encode_;
  // Of the queue's thread.
  std::unique_ptr<OutputFile> file_;
  bool broken_ = false;  ///< so that no later picture waits for the reader too
  WriteQueue queue_;     ///< last, since its thread uses the others
};

}  // namespace hybridrt::cli
