// Holes of textures: one source, compiled as GLSL and as C++ (core/trace/texture_lookup.h) after texture.glsl.

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
