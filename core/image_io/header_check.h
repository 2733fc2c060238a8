#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/image_io/file_bytes.h"
#include "core/image_io/image_limits.h"

namespace hybridrt {

/// What a picture's own header claims.
struct HeaderClaim {
  std::string fault;  ///< why it may not be opened, as a sentence; "": it may
  uint64_t width_px = 0, height_px = 0;
  uint64_t decoding_bytes = 0;  ///< what reading its texels takes at most; 0, and no size, where the reader says so
                                ///< itself when it is opened, before it takes memory for pixels
};

/// Looks at what readers take memory for before anyone could ask them for the size. The decoders go by the very fields
/// that are looked at here.
///  - JPEG 2000 is decoded whole when it is opened: its size, components and tiles (ITU-T T.800, annexes A.5.1, I);
///  - JPEG keeps its coefficients when it has several scans, and makes room for them when it is opened: its frame
///    (ITU-T T.81, annex B.2.2);
///  - GIF's canvas is made when it is opened: its logical screen (GIF89a, section 18);
///  - OpenEXR reserves what an attribute claims, tables for all chunks, and a tile: they must lie in the file ("OpenEXR
///    File Layout").
HeaderClaim header_claim(const std::filesystem::path& path, const TexelLimits& limits);

/// Of one format each.
HeaderClaim jpeg2000_claim(FileBytes& file, const TexelLimits& limits);
HeaderClaim jpeg_claim(FileBytes& file, const TexelLimits& limits);
std::string exr_fault(FileBytes& file, const TexelLimits& limits);

/// Why a picture of that size may not be read, or "".
std::string size_fault(uint64_t width_px, uint64_t height_px, const TexelLimits& limits);

}  // namespace hybridrt
