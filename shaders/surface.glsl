// The surface seen at a pixel and its light: one source, compiled as GLSL and, in single and in double
// precision, as C++ (core/trace/surface.h), so that GPU and CPU shade alike.
// The includer provides Real, Vec3, HRT_FN (`inline` in C++) and HRT_CHOOSE(condition, a, b), both sides of
// which are computed, so that Real may be a vector of many pixels' numbers too.

// Barycentric weights of the point where the line through the origin along `dir` meets the triangle's plane, pulled
// into the triangle: rasterisation snaps vertices to a fraction of a pixel, so a pixel's centre may narrowly miss
// the triangle that it sees.
HRT_FN Vec3 clamped_barycentrics(Vec3 p0, Vec3 p1, Vec3 p2, Vec3 dir) {
  Vec3 e1 = p1 - p0;
  Vec3 e2 = p2 - p0;
  Vec3 p = cross(dir, e2);
  Real determinant = dot(e1, p);
  Real u = max(-dot(p0, p) / determinant, Real(0));
  Real v = max(-dot(dir, cross(p0, e1)) / determinant, Real(0));
  Real outside = max(u + v, Real(1));
  u /= outside;
  v /= outside;
  Vec3 middle = Vec3(Real(1) / Real(3));
  return HRT_CHOOSE(determinant == Real(0), middle, Vec3(Real(1) - u - v, u, v));  // 0: seen edge-on
}

// `normal` on the side that `side` points to (dot >= 0).
HRT_FN Vec3 turned_toward(Vec3 normal, Vec3 side) {
  return HRT_CHOOSE(dot(normal, side) < Real(0), -normal, normal);
}

// `v` as a unit vector; `otherwise` if it has no direction.
HRT_FN Vec3 normalized_or(Vec3 v, Vec3 otherwise) {
  Real squared = dot(v, v);
  return HRT_CHOOSE(squared > Real(0), v / sqrt(squared), otherwise);
}

// The ambient light at a surface with this `normal` (unit): `slope` says from where more of it comes, and how much.
HRT_FN Vec3 ambient_at(Vec3 ambient, Vec3 slope, Vec3 normal) {
  return max(Real(1) + dot(slope, normal), Real(0)) * ambient;
}

// What a surface shows in shadow: emission + ambient light. `opacity` is MTL's d.
HRT_FN Vec3 phong_unlit(Vec3 kd, Vec3 ke, Real opacity, Vec3 ambient) { return ke + opacity * ambient * kd; }

// What one directional light that arrives adds to it, by Blinn and Phong, with the paper's half vector (pass 5).
// `normal`, `to_eye` and `to_light` must be unit. Without an exponent there is no highlight: to the power of 0 it would be
// everywhere.
HRT_FN Vec3 phong_light(Vec3 kd, Vec3 ks, Real ns, Real opacity, Vec3 normal, Vec3 to_eye, Vec3 to_light, Vec3 light) {
  Real cos_light = dot(normal, to_light);
  Vec3 halfway = normalized_or(to_light + to_eye, normal);
  Real highlight = HRT_CHOOSE(ns > Real(0), pow(max(dot(normal, halfway), Real(0)), ns), Real(0));
  Vec3 reflected = light * (opacity * cos_light * kd + highlight * ks);
  return HRT_CHOOSE(cos_light > Real(0), reflected, Vec3(Real(0)));
}
