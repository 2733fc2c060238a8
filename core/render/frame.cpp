#include "core/render/frame.h"

#include "core/base/error.h"

namespace hybridrt {

Image picture_from_rgba(const vec4* rgba, int width_px, int height_px, int64_t& pixels_hit) {
  Image picture(width_px, height_px, 3);
  float* out = picture.data.data();
  int64_t hit = 0, background = 0;
  const size_t count = picture.pixel_count();
  for (size_t i = 0; i < count; ++i) {
    const vec4& pixel = rgba[i];
    hit += pixel.a == 1.0f;
    background += pixel.a == 0.0f;
    *out++ = pixel.r;
    *out++ = pixel.g;
    *out++ = pixel.b;
  }
  if (hit + background != static_cast<int64_t>(count))
    throw error(ErrorKind::device, "the GL driver left {} of {} pixels unwritten",
                static_cast<int64_t>(count) - hit - background, count);
  pixels_hit = hit;
  return picture;
}

}  // namespace hybridrt
