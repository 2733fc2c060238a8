#include <algorithm>

#include "core/image_io/header_check.h"

namespace hybridrt {
namespace {

/// The place behind the next marker, which is read into `marker`; the file's size if there is none. As libjpeg does,
/// bytes that do not belong to one are passed over.
uint64_t next_marker(FileBytes& file, uint64_t place, unsigned char& marker) {
  constexpr size_t kTogether = 4096;
  bool after_ff = false;
  for (; place < file.size(); place += kTogether) {
    const std::string bytes = file.at(place, std::min<uint64_t>(kTogether, file.size() - place));
    for (size_t i = 0; i < bytes.size(); ++i) {
      marker = static_cast<unsigned char>(bytes[i]);
      if (after_ff && marker != 0 && marker != 0xFF) return place + i + 1;
      after_ff = marker == 0xFF;
    }
  }
  return file.size();
}

/// SOF0 to SOF15, without the tables among their codes (DHT, JPG, DAC).
bool begins_frame(unsigned char marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

bool has_no_length(unsigned char marker) { return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8); }

}  // namespace

HeaderClaim jpeg_claim(FileBytes& file, const TexelLimits& limits) {
  constexpr uint64_t kLargestBlock_px = 32;                             // four blocks of eight
  constexpr uint64_t kBytesPerCoefficient = 2, kBytesPerTexel = 4 + 4;  // of the result, and rows on their way
  constexpr unsigned char kScan = 0xDA, kEnd = 0xD9;
  unsigned char marker = 0;
  uint64_t place = next_marker(file, 0, marker);
  while (place < file.size() && marker != kScan && marker != kEnd) {
    if (begins_frame(marker)) {
      const uint64_t height = file.big(place + 3, 2), width = file.big(place + 5, 2),
                     components = file.big(place + 7, 1);
      const uint64_t padded = (width + kLargestBlock_px) * (height + kLargestBlock_px);
      return {size_fault(width, height, limits), width, height,
              padded * (components * kBytesPerCoefficient + kBytesPerTexel)};
    }
    place = next_marker(file, has_no_length(marker) ? place : place + file.big(place, 2), marker);
  }
  return {};
}

}  // namespace hybridrt
