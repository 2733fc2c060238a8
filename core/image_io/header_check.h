#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hybridrt {

/// What a picture's own header claims that its reader would take memory for before anyone could ask it for the size,
/// as a sentence; "" for what may be read, and for formats whose readers ask first:
///  - JPEG 2000 is decoded whole when it is opened: its size, components and tiles (ITU-T T.800, annexes A.5.1, I);
///  - GIF's canvas is made when it is opened: its logical screen (GIF89a, section 18);
///  - OpenEXR reserves what an attribute claims: it must lie in the file ("OpenEXR File
///    Layout").
/// The decoders go by the very fields that are looked at here.
std::string header_fault(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels);

}  // namespace hybridrt
