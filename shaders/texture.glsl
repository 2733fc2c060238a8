// Textures: one source, compiled as GLSL and, in single and in double precision, as C++
// (core/trace/texture_lookup.h), so that GPU and CPU filter alike; hardware samplers are not used. The includer
// provides Real, Vec2, Vec3, HRT_FN and `uint texture_word(uint)`, which reads the words that shared.h describes.

HRT_FN Real texture_number(uint word) { return Real(uintBitsToFloat(texture_word(word))); }

// The linear colour of a texel's display codes.
HRT_FN Vec3 texel_color(uint texel) {
  return Vec3(texture_number(texel & 255u), texture_number((texel >> 8) & 255u), texture_number((texel >> 16) & 255u));
}

// A texel inside a hole does not affect the colour beside it, unless there is nothing else.
HRT_FN Real texel_weight(uint texel) { return Real(int(texel >> 24)) + Real(0.25); }

// Repeats the image, or clamps to its edge. v grows upward, rows downward.
HRT_FN Vec2 place_in_image(Vec2 uv, uint flags) {
  Vec2 place = Vec2(uv.x, Real(1) - uv.y);
  if ((flags & HRT_TEXTURE_CLAMPED) != 0u) return clamp(place, Vec2(0), Vec2(1));
  return place - floor(place);
}

HRT_FN int neighbour(int i, int size, uint flags) {
  bool clamped = (flags & HRT_TEXTURE_CLAMPED) != 0u;
  if (i < 0) return clamped ? 0 : size - 1;
  if (i >= size) return clamped ? size - 1 : 0;
  return i;
}

// Bilinear lookup in a mip level. `first`: its first texel.
HRT_FN Vec3 bilinear(uint first, int width, int height, Vec2 place, uint flags) {
  Real x = place.x * Real(width) - Real(0.5);
  Real y = place.y * Real(height) - Real(0.5);
  int left = int(floor(x));
  int top = int(floor(y));
  Real right_share = x - Real(left);
  Real low_share = y - Real(top);
  int x0 = neighbour(left, width, flags);
  int x1 = neighbour(left + 1, width, flags);
  uint row0 = first + uint(neighbour(top, height, flags) * width);
  uint row1 = first + uint(neighbour(top + 1, height, flags) * width);
  uint t00 = texture_word(row0 + uint(x0));
  uint t10 = texture_word(row0 + uint(x1));
  uint t01 = texture_word(row1 + uint(x0));
  uint t11 = texture_word(row1 + uint(x1));
  Real w00 = (Real(1) - right_share) * (Real(1) - low_share) * texel_weight(t00);
  Real w10 = right_share * (Real(1) - low_share) * texel_weight(t10);
  Real w01 = (Real(1) - right_share) * low_share * texel_weight(t01);
  Real w11 = right_share * low_share * texel_weight(t11);
  return (w00 * texel_color(t00) + w10 * texel_color(t10) + w01 * texel_color(t01) + w11 * texel_color(t11)) /
         (w00 + w10 + w01 + w11);
}

// The area in texture coordinates, squared, that a pixel covers on a triangle with edges e1, e2 and t1, t2 in
// texture coordinates: seen along `dir` (unit) after a path of `distance`, under the solid angle of the pixel. A
// ray cone, unchanged by mirrors and glass: Akenine-Möller et al., "Improved Shader and Texture Level of Detail
// Using Ray Cones", JCGT 10(1), 2021; its area on the surface is solid_angle distance² / cos, which |e1 x e2|
// divides.
HRT_FN Real pixel_footprint(Vec3 e1, Vec3 e2, Vec2 t1, Vec2 t2, Vec3 dir, Real solid_angle, Real distance_along) {
  Real facing = abs(dot(cross(e1, e2), dir));
  Real area = abs(t1.x * t2.y - t1.y * t2.x);
  Real largest = Real(1e30);
  return facing > Real(0) ? min(area * solid_angle * (distance_along / facing * distance_along), largest) : largest;
}

// The solid angle that a sample stands for (a pixel's or its share of one), seen along `dir`, whose component along
// the camera's axis is 1. `sample_area` is its area at distance 1 along that axis.
HRT_FN Real sample_solid_angle(Vec3 dir, Real sample_area) {
  Real squared = dot(dir, dir);
  return sample_area / (squared * sqrt(squared));
}

// The texture of a record at `uv`, trilinear: between the two mip levels around 0.5 log2(texels that a pixel covers).
HRT_FN Vec3 texture_color(uint record, Vec2 uv, Real footprint) {
  int width = int(texture_word(record + HRT_TEXTURE_WIDTH));
  int height = int(texture_word(record + HRT_TEXTURE_HEIGHT));
  int last = int(texture_word(record + HRT_TEXTURE_LEVELS)) - 1;
  uint first = texture_word(record + HRT_TEXTURE_FIRST);
  uint flags = texture_word(record + HRT_TEXTURE_FLAGS);
  Vec2 scale = Vec2(texture_number(record + HRT_TEXTURE_SCALE), texture_number(record + HRT_TEXTURE_SCALE + 1u));
  Vec2 offset = Vec2(texture_number(record + HRT_TEXTURE_OFFSET), texture_number(record + HRT_TEXTURE_OFFSET + 1u));
  Vec2 place = place_in_image(uv * scale + offset, flags);

  Real covered = footprint * abs(scale.x * scale.y) * Real(width) * Real(height);
  Real level = min(Real(0.5) * log2(clamp(covered, Real(1), Real(1e30))), Real(last));
  int finer = int(level);
  for (int i = 0; i < finer; ++i) {
    first += uint(width * height);
    width = max(width / 2, 1);
    height = max(height / 2, 1);
  }
  Vec3 color = bilinear(first, width, height, place, flags);
  Real coarser_share = level - Real(finer);
  if (coarser_share > Real(0)) {
    first += uint(width * height);
    color = mix(color, bilinear(first, max(width / 2, 1), max(height / 2, 1), place, flags), coarser_share);
  }
  color = Vec3(texture_number(record + HRT_TEXTURE_BASE)) + texture_number(record + HRT_TEXTURE_GAIN) * color;
  return max(color, Vec3(0));
}

// `color` times the material's map of this kind (HRT_MAP_*), if it has one. `maps` must not be 0.
HRT_FN Vec3 mapped_color(uint maps, uint kind, Vec3 color, Vec2 uv, Real footprint) {
  uint record = texture_word(maps + kind);
  return record == 0u ? color : color * texture_color(record, uv, footprint);
}

// Whether the surface has a hole at `uv`: alpha under one half at the nearest texel of the finest level, however
// far away, so that all rays and passes see the same holes. `maps` may be 0.
HRT_FN bool has_hole(uint maps, Vec2 uv) {
  if (maps == 0u) return false;
  uint record = texture_word(maps + HRT_MAP_HOLES);
  if (record == 0u) return false;
  int width = int(texture_word(record + HRT_TEXTURE_WIDTH));
  int height = int(texture_word(record + HRT_TEXTURE_HEIGHT));
  Vec2 scale = Vec2(texture_number(record + HRT_TEXTURE_SCALE), texture_number(record + HRT_TEXTURE_SCALE + 1u));
  Vec2 offset = Vec2(texture_number(record + HRT_TEXTURE_OFFSET), texture_number(record + HRT_TEXTURE_OFFSET + 1u));
  Vec2 place = place_in_image(uv * scale + offset, texture_word(record + HRT_TEXTURE_FLAGS));
  int x = min(int(place.x * Real(width)), width - 1);
  int y = min(int(place.y * Real(height)), height - 1);
  return (texture_word(texture_word(record + HRT_TEXTURE_FIRST) + uint(y * width + x)) >> 24) < 128u;
}
