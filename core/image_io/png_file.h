#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <png.h>
#include <string>

namespace hybridrt {

/// A PNG being read by libpng, whose messages come here and not to standard error.
class PngFile {
 public:
  /// Reads the header: everything before the pixels. Throws Error (input), naming the file.
  explicit PngFile(const std::filesystem::path& path);
  ~PngFile();
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  int channels() const { return channels_; }
  int channel_bytes() const { return channel_bytes_; }
  size_t row_bytes() const { return static_cast<size_t>(width_px_) * channels_ * channel_bytes_; }
  /// The last text called Description; empty if there is none.
  std::string description() const;

  /// Hands over all rows from the top, some at a time: `take(bytes, count)`. A channel is one byte, or two in the
  /// machine's order. Throws Error (input) at the first row that cannot be read, and std::bad_alloc.
  void read_rows(const std::function<void(const uint8_t* bytes, int count)>& take);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  /// Whether `work` came to its end. libpng leaves it by longjmp(), so nothing in it may need a destructor.
  template <typename Work>
  bool guarded(Work work);

  const std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::string problem_;
  int width_px_ = 0, height_px_ = 0, channels_ = 0, channel_bytes_ = 0;
  bool interlaced_ = false;
};

}  // namespace hybridrt
