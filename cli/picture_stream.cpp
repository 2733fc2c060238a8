#include "cli/picture_stream.h"

#include <string_view>
#include <utility>

#include "core/base/timing.h"
#include "core/image_io/encode_image.h"

namespace hybridrt::cli {
namespace {

std::string_view text_of(const std::vector<unsigned char>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void PictureStream::submit(Image picture, ImageMetadata metadata, std::function<void(double write_ms)> done) {
  const size_t bytes = memory_bytes(picture);
  const auto job = std::make_shared<const std::pair<Image, ImageMetadata>>(std::move(picture), std::move(metadata));
  queue_.submit(bytes, [this, job, done = std::move(done)] {
    if (broken_) return;
    const Stopwatch writing;
    try {
      write(job->first, job->second);
    } catch (...) {
      broken_ = true;
      throw;
    }
    done(writing.elapsed_ms());
  });
}

void PictureStream::open(const Image& first) {
  file_.reset(target_.name == "-" ? new OutputFile(OutputFile::standard_output()) : new OutputFile(target_.name));
  if (target_.video) file_->write(video_header(*target_.video, first.width_px, first.height_px, target_.rate));
}

void PictureStream::write(const Image& picture, const ImageMetadata& metadata) {
  const std::vector<unsigned char> bytes = target_.video ? video_frame(*target_.video, picture, target_.name)
                                                         : encode_image(picture, "png", metadata, encode_);
  if (!file_) open(picture);
  file_->write(text_of(bytes));
  file_->flush();
}

void PictureStream::finish() {
  queue_.drain();
  if (!file_ || broken_) return;
  file_->commit();
  file_.reset();
}

}  // namespace hybridrt::cli
