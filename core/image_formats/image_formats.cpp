// What the shared object hands out (core/image_io/image_formats.h).

#include "core/image_io/image_formats.h"

#include "core/image_formats/encode_format.h"
#include "core/image_formats/read_format.h"

extern "C" __attribute__((visibility("default"))) const hybridrt::ImageFormats* hybridrt_image_formats_3() {
  static constexpr hybridrt::ImageFormats kFormats = {hybridrt::writer_for,         hybridrt::encode_format,
                                                      hybridrt::read_format,        hybridrt::read_format_texel_size,
                                                      hybridrt::read_format_texels, hybridrt::read_format_description};
  return &kFormats;
}
