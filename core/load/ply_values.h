#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/ply_header.h"
#include "core/load/text_lines.h"
#include "core/load/text_scan.h"

namespace hybridrt {

/// The numbers of a PLY file written as text: one element per line.
class PlyTextValues {
 public:
  PlyTextValues(const std::filesystem::path& path, const PlyHeader& header) : lines_(path, LineJoin::none) {
    for (std::string_view ignored; lines_.line_number() < header.lines && lines_.next(ignored);) {
    }
  }

  /// Goes on to the next element.
  void begin(const PlyElement& element, uint64_t index) {
    for (std::string_view line; lines_.next(line);) {
      rest_ = line;
      if (!trimmed(rest_).empty()) return;
    }
    throw error(ErrorKind::input, "{}: cut short: it ends before {} {} of {}", lines_.path().string(), element.name,
                index + 1, element.count);
  }

  /// A word that is neither a number, nor NaN or infinity, throws.
  double next(PlyType) {
    const std::string_view word = take_word(rest_);
    if (const std::optional<double> number = parse_coordinate(word)) return *number;
    throw error(ErrorKind::input, "{}:{}: {}", lines_.path().string(), lines_.line_number(),
                word.empty() ? "the line has fewer numbers than the header promises"
                             : in_quotes(word) + " is not a usable number");
  }

  /// Throws for lists that the line has no room for.
  void require(uint64_t count, PlyType) const {
    if (count > rest_.size())
      throw error(ErrorKind::input, "{}:{}: a list of {} numbers does not fit the line", lines_.path().string(),
                  lines_.line_number(), count);
  }

  size_t place(uint64_t) const { return lines_.line_number(); }

 private:
  TextLines lines_;
  std::string_view rest_;
};

/// The numbers of a binary PLY file, read in blocks.
class PlyBinaryValues {
 public:
  PlyBinaryValues(const std::filesystem::path& path, const PlyHeader& header)
      : path_(path),
        file_(std::fopen(path.c_str(), "rb"), &std::fclose),
        swap_((header.format == PlyFormat::big_endian) != (std::endian::native == std::endian::big)),
        left_(std::filesystem::file_size(path) - header.bytes) {
    if (!file_ || std::fseek(file_.get(), static_cast<long>(header.bytes), SEEK_SET) != 0)
      throw error(ErrorKind::input, "{} cannot be read", path.string());
  }

  void begin(const PlyElement& element, uint64_t index) { element_ = &element, index_ = index; }

  double next(PlyType type) {
    switch (type) {
      case PlyType::int8: return take<int8_t>();
      case PlyType::uint8: return take<uint8_t>();
      case PlyType::int16: return take<int16_t>();
      case PlyType::uint16: return take<uint16_t>();
      case PlyType::int32: return take<int32_t>();
      case PlyType::uint32: return take<uint32_t>();
      case PlyType::float32: return static_cast<double>(take<float>());
      case PlyType::float64: return take<double>();
    }
    return 0;
  }

  void require(uint64_t count, PlyType type) const {
    if (count > left_ / size_of(type)) cut_short();
  }

  size_t place(uint64_t index) const { return index; }

 private:
  [[noreturn]] void cut_short() const {
    throw error(ErrorKind::input, "{}: cut short: it ends within {} {} of {}", path_.string(), element_->name,
                index_ + 1, element_->count);
  }

  template <typename T>
  T take() {
    if (at_ + sizeof(T) > have_) {
      std::memmove(block_.data(), block_.data() + at_, have_ - at_);
      have_ -= at_;
      at_ = 0;
      have_ += std::fread(block_.data() + have_, 1, block_.size() - have_, file_.get());
      if (have_ < sizeof(T)) cut_short();
    }
    std::array<unsigned char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), block_.data() + at_, sizeof(T));
    if (swap_)
      for (size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    at_ += sizeof(T);
    left_ -= std::min<uint64_t>(left_, sizeof(T));
    return std::bit_cast<T>(bytes);
  }

  const std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  const bool swap_;
  uint64_t left_;
  std::vector<unsigned char> block_ = std::vector<unsigned char>(size_t{1} << 18);
  size_t at_ = 0, have_ = 0;
  const PlyElement* element_ = nullptr;
  uint64_t index_ = 0;
};

}  // namespace hybridrt
