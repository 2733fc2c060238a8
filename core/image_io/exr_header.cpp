#include <algorithm>
#include <fmt/format.h>

#include "core/image_io/header_check.h"

namespace hybridrt {
namespace {

int64_t signed_of(uint64_t bits) { return static_cast<int32_t>(static_cast<uint32_t>(bits)); }

/// A name that ends with a zero byte; `place` is moved behind it.
std::string take_name(FileBytes& file, uint64_t& place) {
  constexpr size_t kLongest = 256;
  const std::string bytes = file.at(place, kLongest);
  const std::string name = bytes.substr(0, bytes.find('\0'));
  place += name.size() + 1;
  return name;
}

/// What a part's header has said so far.
struct Part {
  uint64_t width_px = 0, height_px = 0, tile_width_px = 0, tile_height_px = 0, chunks = 0;
};

/// "" or what is wrong with the attribute, which is noted in `part`.
std::string take_attribute(FileBytes& file, const std::string& name, const std::string& type, uint64_t place,
                           uint64_t size, const TexelLimits& limits, Part& part) {
  if (size > file.size() - std::min(place, file.size()))
    return fmt::format("its attribute '{}' claims {} bytes of a file of {}", name, size, file.size());
  const uint64_t first = file.little(place, 4), second = file.little(place + 4, 4);
  if (type == "preview" && 8 + 4 * first * second != size)
    return fmt::format("its attribute '{}' claims a preview of {}x{} pixels in {} bytes", name, first, second, size);
  if (name == "chunkCount") part.chunks = first;
  if (name == "tiles") part.tile_width_px = first, part.tile_height_px = second;
  if ((name == "tiles" || type == "tiledesc") && first * second == 0) return "its tiles have no pixels";
  if (name != "dataWindow") return "";
  const auto side = [&](uint64_t i) {
    const int64_t begin = signed_of(file.little(place + i, 4)), last = signed_of(file.little(place + 8 + i, 4));
    return static_cast<uint64_t>(std::max<int64_t>(0, last - begin + 1));
  };
  part.width_px = side(0), part.height_px = side(4);
  return size_fault(part.width_px, part.height_px, {limits.largest_side_px, UINT64_MAX});
}

/// OpenEXR makes room for the table of a part's chunks, and for a tile.
std::string part_fault(const FileBytes& file, const Part& part, const TexelLimits& limits) {
  constexpr uint64_t kBytesPerChunk = 8, kAlwaysAllowed_px = 4096 * 4096;
  uint64_t chunks = part.chunks;
  if (part.tile_width_px > 0) {
    const uint64_t texels = part.tile_width_px * part.tile_height_px;  // no overflow: 32 bits each
    if (texels > std::max(kAlwaysAllowed_px, limits.most_texels))
      return fmt::format("its tiles of {}x{} pixels are too large", part.tile_width_px, part.tile_height_px);
    const auto tiles = [](uint64_t side_px, uint64_t tile_px) { return (side_px + tile_px - 1) / tile_px; };
    chunks = std::max(chunks, tiles(part.width_px, part.tile_width_px) * tiles(part.height_px, part.tile_height_px));
  }
  if (chunks * kBytesPerChunk <= file.size()) return "";
  return fmt::format("its header claims {} chunks in a file of {} bytes", chunks, file.size());
}

}  // namespace

std::string exr_fault(FileBytes& file, const TexelLimits& limits) {
  constexpr uint64_t kSeveralParts = 0x1000;
  constexpr int kMostAttributes = 100'000;
  const bool several = file.little(4, 4) & kSeveralParts;
  Part part;
  uint64_t place = 8;
  for (int i = 0; i < kMostAttributes && place < file.size(); ++i) {
    const std::string name = take_name(file, place);
    if (name.empty()) {  // the end of a part's header; of all, if none follows
      if (std::string fault = part_fault(file, part, limits); !fault.empty()) return fault;
      if (!several || file.little(place, 1) == 0) return "";
      part = {};
      continue;
    }
    const std::string type = take_name(file, place);
    const uint64_t size = file.little(place, 4);
    place += 4;
    if (std::string fault = take_attribute(file, name, type, place, size, limits, part); !fault.empty()) return fault;
    place += size;
  }
  return "its header does not end";
}

}  // namespace hybridrt
