// Reading a shadow map (core/passes/shadow_map_fit.h): one source, compiled as GLSL and as C++
// (core/passes/shadow_warp.h).
// The includer provides Real, Vec2, Vec3 and HRT_FN.

// As in ShadowMapFit.
struct MapFit {
  Real inverse_w_slope;
  Real texel_across;
  Real texel_along;
  Real uniform_texel;
  Real misplacement;
  Real lean_first;
  Real lean_step;
  int warped;
  Vec3 across;
  Vec3 along;
};

// w along the row `v`, 0..1, of the map.
HRT_FN Real map_w(Real v, Real inverse_w_slope) { return Real(1) / (Real(1) + inverse_w_slope * v); }

// A texel's width and length at `w`, in units of the map's depth.
HRT_FN Vec2 texel_size(Real across, Real along, Real w) { return Vec2(across * w, along * w * w); }

// The most that depth changes over a texel, on a plane with this `gradient` of depth across and along the warp's
// axis, where texels lean sideways by `lean`.
HRT_FN Real depth_over_texel(Vec2 gradient, Vec2 texel, Real lean) {
  return abs(gradient.x) * texel.x + abs(gradient.y + lean * gradient.x) * texel.y;
}

// How much nearer than the point the map may be without shadow: it holds the depth at a texel's centre only.
// `normal`: the receiver's, unit; `u` and `w`: the point's place on the map.
HRT_FN Real depth_offset(MapFit fit, Vec3 normal, Real cos_light, Real u, Real w) {
  Real most_slope = Real(20);  // bounds the offset where light grazes
  Vec2 texel = texel_size(fit.texel_across, fit.texel_along, w);
  Real widest = max(texel.x, texel.y);
  if (fit.warped == 0) {  // a centre is up to 0.71 texels away along the slope
    Real slope = sqrt(max(Real(1) - cos_light * cos_light, Real(0))) / cos_light;
    return widest * (min(slope, most_slope) + Real(0.2));
  }
  Vec2 gradient = Vec2(dot(normal, fit.across), dot(normal, fit.along)) / cos_light;
  Real misplaced = fit.misplacement * w * (Real(1) + min(length(gradient), most_slope));
  Real half_texel = Real(0.5) * depth_over_texel(gradient, texel, fit.lean_first + fit.lean_step * u);
  return min(half_texel, most_slope * fit.uniform_texel) + max(Real(0.2) * widest, misplaced);
}
