#include "core/image_io/header_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <string_view>

namespace hybridrt {
namespace {

/// A file's bytes, read where they are needed; zeros past its end.
class Bytes {
 public:
  explicit Bytes(const std::filesystem::path& path) : file_(path, std::ios::binary) {
    file_.seekg(0, std::ios::end);
    size_ = file_ ? static_cast<uint64_t>(file_.tellg()) : 0;
  }
  uint64_t size() const { return size_; }
  std::string at(uint64_t place, size_t count) {
    std::string bytes(count, '\0');
    if (place >= size_) return bytes;
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(place));
    file_.read(bytes.data(), static_cast<std::streamsize>(count));
    return bytes;
  }
  uint64_t big(uint64_t place, int count) {
    uint64_t value = 0;
    for (const char c : at(place, static_cast<size_t>(count))) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  }
  uint64_t little(uint64_t place, int count) {
    std::string bytes = at(place, static_cast<size_t>(count));
    uint64_t value = 0;
    for (auto c = bytes.rbegin(); c != bytes.rend(); ++c) value = value << 8 | static_cast<unsigned char>(*c);
    return value;
  }

 private:
  std::ifstream file_;
  uint64_t size_ = 0;
};

std::string size_fault(uint64_t width, uint64_t height, int largest_side_px, uint64_t most_texels) {
  const auto side = static_cast<uint64_t>(largest_side_px);
  if (width <= side && height <= side && width * height <= most_texels) return "";
  return fmt::format("{}x{} pixels are too large; at most {} on a side and {} in all", width, height, side,
                     most_texels);
}

/// Where the codestream begins: at once, or in the first box of that kind. The file's size if there is none.
uint64_t codestream_of(Bytes& file) {
  constexpr uint64_t kCodestreamBox = 0x6A703263;  // "jp2c"
  if (file.big(0, 4) == 0xFF4FFF51) return 0;
  if (file.big(0, 8) != 0x0000000C6A502020) return file.size();
  constexpr int kMostBoxes = 10'000;
  uint64_t box = 0;
  for (int i = 0; i < kMostBoxes && box < file.size(); ++i) {
    const uint64_t length = file.big(box, 4);
    if (file.big(box + 4, 4) == kCodestreamBox) return box + (length == 1 ? 16 : 8);
    const uint64_t whole = length == 1 ? file.big(box + 8, 8) : length;
    if (whole < 8 || whole > file.size() - box) return file.size();
    box += whole;
  }
  return file.size();
}

/// OpenJPEG keeps 32 bits a component and pixel, OpenImageIO the finished picture beside it, and a record for each tile
/// and each component of a tile.
std::string jpeg2000_fault(Bytes& file, int largest_side_px, uint64_t most_texels) {
  constexpr uint64_t kBytesPerSample = 8, kBytesPerTile = 6000, kBytesPerTileComponent = 1200, kBytesPerTexel = 16;
  const uint64_t start = codestream_of(file);
  if (start >= file.size()) return "";
  if (file.big(start, 4) != 0xFF4FFF51) return "its JPEG 2000 codestream does not begin with a size";
  const auto field = [&](int i) { return file.big(start + 8 + 4 * static_cast<uint64_t>(i), 4); };
  const uint64_t x0 = field(2), y0 = field(3), components = file.big(start + 40, 2);
  const uint64_t width = field(0) - std::min(x0, field(0)), height = field(1) - std::min(y0, field(1));
  if (const std::string fault = size_fault(width, height, largest_side_px, most_texels); !fault.empty()) return fault;
  const uint64_t tile_width = std::max<uint64_t>(field(4), 1), tile_height = std::max<uint64_t>(field(5), 1);
  const uint64_t tiles = (field(0) / tile_width + 1) * (field(1) / tile_height + 1);
  constexpr uint64_t kMostTiles = 65535;  // of the format
  const uint64_t bytes = width * height * components * kBytesPerSample +
                         std::min(tiles, kMostTiles) * (kBytesPerTile + components * kBytesPerTileComponent);
  constexpr uint64_t kAlwaysAllowed = uint64_t{64} << 20;
  if (bytes <= std::max(kAlwaysAllowed, most_texels * kBytesPerTexel)) return "";
  return fmt::format(
      "decoding {}x{} pixels with {} components in {} tiles takes {:.1f} GB, which is too much; save it as "
      "PNG or TIFF",
      width, height, components, tiles, static_cast<double>(bytes) * 1e-9);
}

int64_t signed_of(uint64_t bits) { return static_cast<int32_t>(static_cast<uint32_t>(bits)); }

/// A name that ends with a zero byte; `place` is moved behind it.
std::string take_name(Bytes& file, uint64_t& place) {
  constexpr size_t kLongest = 256;
  const std::string bytes = file.at(place, kLongest);
  const std::string name = bytes.substr(0, bytes.find('\0'));
  place += name.size() + 1;
  return name;
}

std::string exr_attribute_fault(Bytes& file, const std::string& name, const std::string& type, uint64_t place,
                                uint64_t size, int largest_side_px) {
  if (size > file.size() - std::min(place, file.size()))
    return fmt::format("its attribute '{}' claims {} bytes of a file of {}", name, size, file.size());
  if (type == "preview" && 8 + 4 * file.little(place, 4) * file.little(place + 4, 4) != size)
    return fmt::format("its attribute '{}' claims a preview of {}x{} pixels in {} bytes", name, file.little(place, 4),
                       file.little(place + 4, 4), size);
  if (type == "tiledesc" && file.little(place, 4) * file.little(place + 4, 4) == 0) return "its tiles have no pixels";
  if (name != "dataWindow") return "";
  const auto side = [&](uint64_t i) {
    return std::max<int64_t>(0, signed_of(file.little(place + 8 + i, 4)) - signed_of(file.little(place + i, 4)) + 1);
  };
  return size_fault(static_cast<uint64_t>(side(0)), static_cast<uint64_t>(side(4)), largest_side_px, UINT64_MAX);
}

/// Of the header of each part.
std::string exr_fault(Bytes& file, int largest_side_px) {
  constexpr uint64_t kSeveralParts = 0x1000;
  constexpr int kMostAttributes = 100'000;
  const bool several = file.little(4, 4) & kSeveralParts;
  uint64_t place = 8;
  for (int i = 0; i < kMostAttributes && place < file.size(); ++i) {
    const std::string name = take_name(file, place);
    if (name.empty()) {  // the end of a header; of all, if none follows
      if (!several || file.little(place, 1) == 0) return "";
      continue;
    }
    const std::string type = take_name(file, place);
    const uint64_t size = file.little(place, 4);
    place += 4;
    if (std::string fault = exr_attribute_fault(file, name, type, place, size, largest_side_px); !fault.empty())
      return fault;
    place += size;
  }
  return "its header does not end";
}

}  // namespace

std::string header_fault(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels) {
  Bytes file(path);
  const std::string start = file.at(0, 4);
  if (start == "GIF8") return size_fault(file.little(6, 2), file.little(8, 2), largest_side_px, most_texels);
  if (file.little(0, 4) == 20000630) return exr_fault(file, largest_side_px);
  return jpeg2000_fault(file, largest_side_px, most_texels);
}

}  // namespace hybridrt
