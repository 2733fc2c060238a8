#include <algorithm>
#include <fmt/format.h>

#include "core/image_io/header_check.h"

namespace hybridrt {
namespace {

/// Where the codestream begins: at once, or in the first box of that kind. The file's size if there is none.
uint64_t codestream_of(FileBytes& file) {
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

}  // namespace

/// OpenJPEG keeps 32 bits a component and pixel, OpenImageIO the finished picture beside it, and a record for each tile
/// and each component of a tile.
HeaderClaim jpeg2000_claim(FileBytes& file, const TexelLimits& limits) {
  constexpr uint64_t kBytesPerSample = 8, kBytesPerTile = 6000, kBytesPerTileComponent = 1200, kBytesPerTexel = 16;
  const uint64_t start = codestream_of(file);
  if (start >= file.size()) return {};
  if (file.big(start, 4) != 0xFF4FFF51) return {"its JPEG 2000 codestream does not begin with a size"};
  const auto field = [&](int i) { return file.big(start + 8 + 4 * static_cast<uint64_t>(i), 4); };
  const uint64_t x0 = field(2), y0 = field(3), components = file.big(start + 40, 2);
  const uint64_t width = field(0) - std::min(x0, field(0)), height = field(1) - std::min(y0, field(1));
  if (const std::string fault = size_fault(width, height, limits); !fault.empty()) return {fault};
  const uint64_t tile_width = std::max<uint64_t>(field(4), 1), tile_height = std::max<uint64_t>(field(5), 1);
  const uint64_t tiles = (field(0) / tile_width + 1) * (field(1) / tile_height + 1);
  constexpr uint64_t kMostTiles = 65535;  // of the format
  const uint64_t bytes = width * height * components * kBytesPerSample +
                         std::min(tiles, kMostTiles) * (kBytesPerTile + components * kBytesPerTileComponent);
  constexpr uint64_t kAlwaysAllowed = uint64_t{64} << 20;
  if (bytes <= std::max(kAlwaysAllowed, limits.most_texels * kBytesPerTexel))
    return {"", width, height, bytes + kBytesPerTexel * width * height};
  return {
      fmt::format("decoding {}x{} pixels with {} components in {} tiles takes {:.1f} GB, which is too much; save it as "
                  "PNG or TIFF",
                  width, height, components, tiles, static_cast<double>(bytes) * 1e-9)};
}

}  // namespace hybridrt
