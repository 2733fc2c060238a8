#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include "core/image/texel_image.h"

namespace hybridrt {

/// How far loading has come: written by loaders on any thread, read by whoever shows it.
struct LoadProgress {
  std::atomic<uint64_t> bytes{0}, bytes_read{0};  ///< bytes of all files, and of those that have been read
};

/// The memory limit of loading, how it reads textures, where it reports progress, and how colours are meant.
struct LoadWatch {
  uint64_t most_bytes =
      std::numeric_limits<uint64_t>::max();  ///< memory limit; scenes that would take more are refused
  LoadProgress* progress = nullptr;
  TexelFiles textures = {};    ///< empty: textures are left out
  bool linear_colors = false;  ///< colours of vertices and faces are linear, not sRGB
};

}  // namespace hybridrt
