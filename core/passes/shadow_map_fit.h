#pragma once

#include <span>

#include "core/passes/light_frame.h"
#include "core/scene/view.h"

namespace hybridrt {

/// Maps the scene's points to a shadow map: a projective map whose w depends on one direction across the light only and
/// whose depth is linear along the light.
///
///     (u w, v w, z, w) = map_from_origin * (position - origin, 1)
///
/// u and v are 0..1 over the map; z is the place along the light, as a share of the scene's depth, grows away from the
/// light and is 0 at the origin, so that it lies in -1..1; w is 1 along the row v = 0 and grows with v. Hardware
/// divides z by w too, so the map holds 0.5 + 0.5 z / w: an error of w, which is large where a triangle reaches far
/// beyond the map, only moves what is far from the origin along the light. As w is constant along a row of texels,
///
///     1 / w = 1 + inverse_w_slope * v,
///
/// z is recovered with little rounding, and no shader need write depths.
struct ShadowMapFit {
  dvec3 origin{0};  ///< scene space; subtracted first, so that what is near it is precise in float
  dmat4 map_from_origin{1};
  double inverse_w_slope = 0;  ///< 0 without warp, else in (-1, 0)
  bool warped = false;         ///< false for lispsm too if there are no receivers
  dvec3 across{0}, along{0};   ///< unit, scene space, perpendicular to the light: directions of u, and of v and w
  double texel_across = 0;     ///< a texel is texel_across * w wide, in units of z, ...
  double texel_along = 0;      ///< ... and texel_along * w^2 long, measured straight along `along`
  double uniform_texel = 0;    ///< the longer side of a texel of uniform_shadow_map()
  double misplacement = 0;     ///< times w: how far rounding may move what the map holds, in units of z
  double lean_first = 0, lean_step = 0;  ///< lines of equal u lean to `across` by lean_first + lean_step * u
};

/// Covers all of the light's box, without warp; independent of the view.
ShadowMapFit uniform_shadow_map(const LightFrame& light, int size_px);

/// Light space perspective shadow map (M. Wimmer, D. Scherzer, W. Purgathofer, "Light Space Perspective Shadow Maps",
/// EGSR 2004): fitted to the convex hull of `receivers`, points relative to view.eye in front of it, with the warp that
/// evens out texels per pixel over the picture, n = (z0 + sqrt(z0 z1)) / sin(view, light). The pole may move sideways;
/// its place is chosen so that the receivers fill the map, since under a low light a floor would be a thin line across
/// it. What casts shadows on them is in the map as well, as it holds all that lies before and behind the hull along the
/// light. Where view and light are nearly parallel it is fitted without warp; without receivers it is
/// uniform_shadow_map(). Always finite, and w >= 1 over the map. `light` gives direction and range of depths.
ShadowMapFit fit_shadow_map(const LightFrame& light, const View& view, std::span<const dvec3> receivers, int size_px);

}  // namespace hybridrt
