// Reading a warped shadow map (core/passes/shadow_map_fit.h): compiled as GLSL and, by a test, as C++.
// The includer provides Real, Vec2 and HRT_FN.

// w along the row `v`, 0..1, of the map.
HRT_FN Real map_w(Real v, Real inverse_w_slope) { return Real(1) / (Real(1) + inverse_w_slope * v); }

// A texel's width and length at `w`, in units of the map's depth.
HRT_FN Vec2 texel_size(Real across, Real along, Real w) { return Vec2(across * w, along * w * w); }

// The most that depth changes over a texel, on a plane with this `gradient` of depth across and along the warp's
// axis, where texels lean sideways by `lean`.
HRT_FN Real depth_over_texel(Vec2 gradient, Vec2 texel, Real lean) {
  return abs(gradient.x) * texel.x + abs(gradient.y + lean * gradient.x) * texel.y;
}
