// Reading a warped shadow map (core/scene/shadow_map_fit.h): compiled as GLSL and, by a test, as C++.
// The includer provides Real and HRT_FN.

// All along the row `v`, 0..1, of the map.
HRT_FN Real map_w(Real v, Real inverse_w_slope) { return Real(1) / (Real(1) + inverse_w_slope * v); }

// A texel's width there, in units of the map's depth.
HRT_FN Real texel_depth(Real across, Real along, Real w) { return max(across * w, along * w * w); }
