#pragma once

#include <string>

#include "core/image/image.h"

namespace hybridrt {

/// "png" of "out/a.png", ".png" and "png"; empty where there is none.
std::string extension_of(const std::string& format_or_name);

/// The picture with one or three colour channels, and its alpha if wanted: grey is repeated, channels beyond the third
/// are left out. Its layers and camera are left out too.
Image with_channels(const Image& image, int colors, bool alpha);

}  // namespace hybridrt
