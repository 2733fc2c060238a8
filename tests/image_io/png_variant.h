#pragma once

#include <cstdint>
#include <cstdlib>
#include <png.h>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace hybridrt {

/// One kind of PNG file.
struct PngVariant {
  int color_type, bit_depth;
  bool interlaced = false, transparent_color = false, gamma = false;
  std::string description = {};
  int text_compression = PNG_TEXT_COMPRESSION_NONE;  ///< also PNG_TEXT_COMPRESSION_zTXt, PNG_ITXT_COMPRESSION_NONE
};

/// All that the standard allows (table 11.1).
inline std::vector<PngVariant> png_variants() {
  std::vector<PngVariant> variants;
  const auto add = [&](int color_type, std::initializer_list<int> depths) {
    for (const int depth : depths)
      for (const bool interlaced : {false, true})
        for (const bool transparent : {false, true}) {
          if (transparent && (color_type & PNG_COLOR_MASK_ALPHA)) continue;
          variants.push_back({color_type, depth, interlaced, transparent, interlaced != transparent, "", 0});
        }
  };
  add(PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16});
  add(PNG_COLOR_TYPE_RGB, {8, 16});
  add(PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8});
  add(PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16});
  add(PNG_COLOR_TYPE_RGB_ALPHA, {8, 16});
  return variants;
}

/// A file of that kind with random pixels, by libpng.
inline std::string write_png_variant(const PngVariant& variant, int width, int height, uint32_t seed) {
  std::mt19937 random(seed);
  std::string file;
  const auto fail = [](png_structp, png_const_charp message) { throw std::runtime_error(message); };
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &file,
      [](png_structp of, png_bytep bytes, size_t count) {
        static_cast<std::string*>(png_get_io_ptr(of))->append(reinterpret_cast<char*>(bytes), count);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), variant.bit_depth,
               variant.color_type, variant.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, 0, 0);
  if (variant.gamma) png_set_gAMA(png, info, 0.8);
  if (variant.color_type == PNG_COLOR_TYPE_PALETTE) {
    std::vector<png_color> palette(size_t{1} << variant.bit_depth);
    for (png_color& color : palette)
      color = {static_cast<png_byte>(random()), static_cast<png_byte>(random()), static_cast<png_byte>(random())};
    png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    png_byte alphas[] = {0, 100};
    if (variant.transparent_color) png_set_tRNS(png, info, alphas, 2, nullptr);
  } else if (variant.transparent_color) {
    const auto some = static_cast<png_uint_16>(random() % (1u << variant.bit_depth));
    const png_color_16 color = {0, some, some, some, some};
    png_set_tRNS(png, info, nullptr, 0, &color);
  }
  std::string key = "Description", text = variant.description;
  if (!text.empty()) {
    png_text entry{};
    entry.compression = variant.text_compression;
    entry.key = key.data(), entry.text = text.data();
    png_set_text(png, info, &entry, 1);
  }
  png_write_info(png, info);
  const size_t row_bytes = png_get_rowbytes(png, info);
  std::vector<png_byte> pixels(row_bytes * static_cast<size_t>(height));
  for (png_byte& byte : pixels) byte = static_cast<png_byte>(random());
  std::vector<png_bytep> rows;
  for (int y = 0; y < height; ++y) rows.push_back(pixels.data() + row_bytes * static_cast<size_t>(y));
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return file;
}

}  // namespace hybridrt
