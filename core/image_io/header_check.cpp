#include "core/image_io/header_check.h"

#include <fmt/format.h>

namespace hybridrt {

std::string size_fault(uint64_t width, uint64_t height, const TexelLimits& limits) {
  const auto side = static_cast<uint64_t>(limits.largest_side_px);
  if (width <= side && height <= side && width * height <= limits.most_texels) return "";
  return fmt::format("{}x{} pixels are too large; at most {} on a side and {} in all", width, height, side,
                     limits.most_texels);
}

HeaderClaim header_claim(const std::filesystem::path& path, const TexelLimits& limits) {
  FileBytes file(path);
  if (file.at(0, 4) == "GIF8") {
    constexpr uint64_t kBytesPerTexel = 12;  // the canvas, the frame and the result
    const uint64_t width = file.little(6, 2), height = file.little(8, 2);
    return {size_fault(width, height, limits), width, height, kBytesPerTexel * width * height};
  }
  if (file.little(0, 4) == 20000630) return {exr_fault(file, limits)};
  if (file.big(0, 2) == 0xFFD8) return jpeg_claim(file, limits);
  return jpeg2000_claim(file, limits);
}

}  // namespace hybridrt
