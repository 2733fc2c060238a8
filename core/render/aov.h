#pragma once

#include "core/render/frame.h"

#include <cstdint>
#include <span>

namespace hybridrt {

/// Per-pixel arrays of a frame that AOVs are made from; empty where a frame did not need them.
struct AovSource {
  std::span<const uint32_t> ids;
  std::span<const uint8_t> mask;  ///< HRT_MASK_* of passes 2 and 3
  std::span<const uint8_t> lit;   ///< HRT_MASK_LIT, final; takes precedence over `mask`
  std::span<const vec4> traced;
};

/// The pictures that `aovs` (Aov bits) asks for, black where the frame had nothing to say.
std::vector<AovImage> make_aovs(const Scene& scene, const View& view, const AovSource& source, uint32_t aovs);

}  // namespace hybridrt
