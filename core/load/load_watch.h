#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include "core/image/texel_image.h"

namespace hybridrt {

/// How far loading is: written by loaders on any thread, read by whoever shows it.
struct LoadProgress {
  std::atomic<uint64_t> bytes{0}, bytes_read{0};  ///< of all files, and of these the ones that are read
};

/// What loading must keep to, what it reads textures by, and whom it tells how far it is.
struct LoadWatch {
  uint64_t most_bytes = std::numeric_limits<uint64_t>::max();  ///< of memory; scenes that would take more are refused
  LoadProgress* progress = nullptr;
  TexelReader read_texels = {};  ///< null: textures are left out
};

}  // namespace hybridrt
