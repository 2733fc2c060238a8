// Textures: one source, compiled as GLSL and, on single and double numbers and on vectors of them, as C++
// (core/trace/texture_lookup.h, texture_lanes-inl.h), so that GPU and CPU filter alike; hardware samplers are not used.
// The includer provides Real, Vec2, Vec3, HRT_FN, HRT_CHOOSE(condition, a, b), both sides of which are computed, and
// HRT_ANY(condition). Int and Uint are whole numbers of one pixel, or of many as Real is; int and uint are the same for
// all of them. `uint texture_word(uint)` and `Uint texel_word(Uint)` read the words that shared.h describes.

HRT_FN Real texture_number(uint word) { return Real(uintBitsToFloat(texture_word(word))); }

// The linear value of a display code.
HRT_FN Real display_value(Uint code) { return Real(uintBitsToFloat(texel_word(code))); }

HRT_FN Vec3 texel_color(Uint texel) {
  Uint all = Uint(255u);
  return Vec3(display_value(texel & all), display_value((texel >> 8) & all), display_value((texel >> 16) & all));
}

// A texel inside a hole does not affect the colour beside it, unless there is nothing else.
HRT_FN Real texel_weight(Uint texel) { return Real(Int(texel >> 24)) + Real(0.25); }

// Repeats the image, or clamps to its edge. v grows upward, rows downward.
HRT_FN Vec2 place_in_image(Vec2 uv, uint flags) {
  Vec2 place = Vec2(uv.x, Real(1) - uv.y);
  if ((flags & HRT_TEXTURE_CLAMPED) != 0u) return clamp(place, Vec2(Real(0)), Vec2(Real(1)));
  return place - floor(place);
}

HRT_FN Int neighbour(Int i, Int size, uint flags) {
  bool clamped = (flags & HRT_TEXTURE_CLAMPED) != 0u;
  Int first = Int(0);
  Int last = size - Int(1);
  Int below = clamped ? first : last;
  Int above = clamped ? last : first;
  return HRT_CHOOSE(i < first, below, HRT_CHOOSE(i < size, i, above));
}

// Bilinear lookup in a mip level. `first`: its first texel.
HRT_FN Vec3 bilinear(Uint first, Int width, Int height, Vec2 place, uint flags) {
  Real x = place.x * Real(width) - Real(0.5);
  Real y = place.y * Real(height) - Real(0.5);
  Int left = Int(floor(x));
  Int top = Int(floor(y));
  Real right_share = x - Real(left);
  Real low_share = y - Real(top);
  Uint x0 = Uint(neighbour(left, width, flags));
  Uint x1 = Uint(neighbour(left + Int(1), width, flags));
  Uint row0 = first + Uint(neighbour(top, height, flags) * width);
  Uint row1 = first + Uint(neighbour(top + Int(1), height, flags) * width);
  Uint t00 = texel_word(row0 + x0);
  Uint t10 = texel_word(row0 + x1);
  Uint t01 = texel_word(row1 + x0);
  Uint t11 = texel_word(row1 + x1);
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
  Real seen = min(area * solid_angle * (distance_along / facing * distance_along), largest);
  return HRT_CHOOSE(facing > Real(0), seen, largest);
}

// The solid angle that a sample stands for (a pixel's or its share of one), seen along `dir`, whose component along
// the camera's axis is 1. `sample_area` is its area at distance 1 along that axis.
HRT_FN Real sample_solid_angle(Vec3 dir, Real sample_area) {
  Real squared = dot(dir, dir);
  return sample_area / (squared * sqrt(squared));
}

// The texture of a record at `uv`, trilinear: between the two mip levels around 0.5 log2(texels that a pixel covers).
HRT_FN Vec3 texture_color(uint record, Vec2 uv, Real footprint) {
  Int width = Int(int(texture_word(record + HRT_TEXTURE_WIDTH)));
  Int height = Int(int(texture_word(record + HRT_TEXTURE_HEIGHT)));
  int last = int(texture_word(record + HRT_TEXTURE_LEVELS)) - 1;
  Uint first = Uint(texture_word(record + HRT_TEXTURE_FIRST));
  uint flags = texture_word(record + HRT_TEXTURE_FLAGS);
  Vec2 scale = Vec2(texture_number(record + HRT_TEXTURE_SCALE), texture_number(record + HRT_TEXTURE_SCALE + 1u));
  Vec2 offset = Vec2(texture_number(record + HRT_TEXTURE_OFFSET), texture_number(record + HRT_TEXTURE_OFFSET + 1u));
  Vec2 place = place_in_image(uv * scale + offset, flags);

  Real covered = footprint * abs(scale.x * scale.y) * Real(width) * Real(height);
  Real level = min(Real(0.5) * log2(clamp(covered, Real(1), Real(1e30))), Real(last));
  Int finer = Int(level);
  for (int i = 0; i < last && HRT_ANY(Int(i) < finer); ++i) {
    first = HRT_CHOOSE(Int(i) < finer, first + Uint(width * height), first);
    width = HRT_CHOOSE(Int(i) < finer, max(width >> 1, Int(1)), width);
    height = HRT_CHOOSE(Int(i) < finer, max(height >> 1, Int(1)), height);
  }
  Vec3 color = bilinear(first, width, height, place, flags);
  Real coarser_share = level - Real(finer);
  if (HRT_ANY(coarser_share > Real(0))) {
    // Pixels without a share in the coarser level may have no such level.
    first = HRT_CHOOSE(coarser_share > Real(0), first + Uint(width * height), first);
    color = mix(color, bilinear(first, max(width >> 1, Int(1)), max(height >> 1, Int(1)), place, flags), coarser_share);
  }
  color = Vec3(texture_number(record + HRT_TEXTURE_BASE)) + texture_number(record + HRT_TEXTURE_GAIN) * color;
  return max(color, Vec3(Real(0)));
}

// `color` times the material's map of this kind (HRT_MAP_*), if it has one. `maps` must not be 0.
HRT_FN Vec3 mapped_color(uint maps, uint kind, Vec3 color, Vec2 uv, Real footprint) {
  uint record = texture_word(maps + kind);
  if (record == 0u) return color;
  return color * texture_color(record, uv, footprint);
}
