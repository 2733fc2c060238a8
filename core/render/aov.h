#pragma once

#include <cstdint>
#include <span>

#include "core/render/frame.h"

namespace hybridrt {

/// A frame's arrays of pixels that AOVs are made from; empty where the frame did not need them.
struct AovSource {
  std::span<const DirectionalLight> lights;
  std::span<const uint32_t> ids;
  std::span<const uint8_t> mask;  ///< HRT_MASK_* of passes 2 and 3, light after light
  std::span<const uint8_t> lit;   ///< HRT_MASK_LIT, final, light after light; takes precedence over `mask`
  std::span<const vec4> traced;
};

/// The depth where nothing is seen: far behind everything, as compositing programs expect.
constexpr float kDepthOfNothing = 1e10f;

/// The AOVs in `aovs` (Aov bits), for the part `kept` of the view's pixels, 0 where the frame has no value:
///  - id: triangle numbers, kNoTriangle where none is seen
///  - shadow: of the lights that cast shadows, the share that arrives; 1 or 0 with one light
///  - marked: the MarkReason of any light
///  - traced: R, G, B, linear
///  - depth: distance along the view, in scene units; kDepthOfNothing where nothing is seen
///  - normal: X, Y, Z of the shading normal in world space (y up), -1..1, unit
///
/// Channels are named as compositing programs read them: id, shadow, marked, traced.R, Z, N.X and so on.
std::vector<ImageLayer> make_aovs(const Scene& scene, const View& view, const PixelRect& kept, const AovSource& source,
                                  uint32_t aovs);

/// An AOV as a linear picture to look at: ids hashed to colours, depth as a share of the farthest in the picture,
/// normals as (n + 1) / 2, black where nothing is seen.
Image display_image(const ImageLayer& aov, int width_px, int height_px);

}  // namespace hybridrt
