#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image_io/image_formats.h"

namespace hybridrt {

/// The format of an extension ("exr"), if it is one of ours that OpenImageIO writes.
std::optional<WrittenFormat> writer_for(const std::string& extension);

/// As encode_image() of image_io, for formats that writer_for() knows (but EXR) and finite pictures with pixels.
std::vector<unsigned char> encode_format(const Image& linear, const std::string& format_or_name,
                                         const ImageMetadata& metadata);

}  // namespace hybridrt
