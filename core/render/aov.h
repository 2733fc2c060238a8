#pragma once

#include <cstdint>
#include <span>

#include "core/render/frame.h"

namespace hybridrt {

/// Per-pixel arrays of a frame that AOVs are made from; empty where a frame did not need them.
struct AovSource {
  std::span<const DirectionalLight> lights;
  std::span<const uint32_t> ids;
  std::span<const uint8_t> mask;  ///< HRT_MASK_* of passes 2 and 3, light after light
  std::span<const uint8_t> lit;   ///< HRT_MASK_LIT, final, light after light; takes precedence over `mask`
  std::span<const vec4> traced;
};

/// What `aovs` (Aov bits) asks for, over the part `kept` of the view's pixels, 0 where the frame had nothing
/// to say:
///  - id: triangle numbers, kNoTriangle where none is seen
///  - shadow: the share of the lights that arrive, of those that cast shadows; 1 or 0 with one
///  - marked: a MarkReason, that of any light
///  - traced: R, G, B, linear
///  - depth: distance along the view, in scene units
///  - normal: X, Y, Z of the shading normal, -1..1
std::vector<ImageLayer> make_aovs(const Scene& scene, const View& view, const PixelRect& kept, const AovSource& source,
                                  uint32_t aovs);

/// An AOV as a picture to look at, linear: ids hashed to colours, depth as a share of the picture's farthest,
/// normals as (n + 1) / 2, black where nothing is seen.
Image display_image(const ImageLayer& aov, int width_px, int height_px);

}  // namespace hybridrt
