#include "core/image_io/png_file.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <csetjmp>
#include <new>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/base/error.h"
#include "core/base/uninitialized.h"
#include "core/image_io/image_limits.h"
#include "core/image_io/png_check.h"

namespace hybridrt {
namespace {

constexpr int kStripRows = 64;
constexpr png_alloc_size_t kMostTextBytes = 8'000'000;  // that a compressed text may become; longer ones are left out

void leave(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

}  // namespace

template <typename Work>
bool PngFile::guarded(Work work) {
  if (setjmp(png_jmpbuf(png_))) return false;
  work();
  return true;
}

PngFile::PngFile(const std::filesystem::path& path) : path_(path), file_(std::fopen(path.c_str(), "rb")) {
  if (!file_)
    throw error(ErrorKind::input, "{}: cannot be read: {}; check the path and its permissions", path.string(),
                std::generic_category().message(errno));
  if (const std::string fault = png_length_fault(path); !fault.empty())
    throw error(ErrorKind::input, "{}: broken image: {}; write or copy it again", path.string(), fault);
  png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &problem_, leave, ignore);
  info_ = png_ ? png_create_info_struct(png_) : nullptr;
  const bool read = info_ && guarded([this] {
                      png_init_io(png_, file_.get());
                      png_set_chunk_malloc_max(png_, kMostTextBytes);
                      png_read_info(png_, info_);
                      png_set_expand(png_);  // palettes, fewer than eight bits, transparent colours
                      if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
                      interlaced_ = png_set_interlace_handling(png_) > 1;
                      png_read_update_info(png_, info_);
                    });
  if (!read) {
    const bool no_memory = !info_;
    png_destroy_read_struct(&png_, &info_, nullptr);
    if (no_memory) throw std::bad_alloc();
    throw error(ErrorKind::input, "{}: not a readable image: {}; use a whole PNG, JPEG, EXR, TIFF or the like",
                path.string(), problem_);
  }
  width_px_ = static_cast<int>(png_get_image_width(png_, info_));
  height_px_ = static_cast<int>(png_get_image_height(png_, info_));
  channels_ = png_get_channels(png_, info_);
  channel_bytes_ = png_get_bit_depth(png_, info_) == 16 ? 2 : 1;
}

PngFile::~PngFile() { png_destroy_read_struct(&png_, &info_, nullptr); }

std::string PngFile::description() const {
  png_textp texts = nullptr;
  const int count = png_get_text(png_, info_, &texts, nullptr);
  std::string found;
  for (int i = 0; i < count; ++i)
    if (std::string_view(texts[i].key) == "Description" && texts[i].text) found = texts[i].text;
  return found;
}

void PngFile::read_rows(const std::function<void(const uint8_t* bytes, int count)>& take) {
  // The passes of an interlaced file each go over the whole picture.
  const int together = interlaced_ ? height_px_ : std::min(height_px_, kStripRows);
  UninitializedVector<uint8_t> strip(row_bytes() * together);
  std::vector<png_bytep> rows(together);
  for (int i = 0; i < together; ++i) rows[i] = strip.data() + row_bytes() * i;
  for (int y = 0; y < height_px_; y += together) {
    const int count = std::min(together, height_px_ - y);
    const bool read = guarded([this, &rows, count] {
      if (interlaced_)
        png_read_image(png_, rows.data());
      else
        png_read_rows(png_, rows.data(), nullptr, static_cast<png_uint_32>(count));
    });
    if (!read)
      throw error(ErrorKind::input, "{}: broken image, row {} and on: {}; write or copy it again", path_.string(), y,
                  problem_);
    take(strip.data(), count);
  }
}

}  // namespace hybridrt
