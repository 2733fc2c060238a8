#include "core/image/srgb.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace hybridrt {
namespace {

/// The top bits of the float select a code, which one comparison corrects: a bucket spans 1/256 of its value, over
/// which the curve rises by less than half a code. Below 2^-13 every code is 0.
struct CodeTable {
  static constexpr uint32_t kShift = 15;
  static constexpr uint32_t kFirst = std::bit_cast<uint32_t>(0x1p-13f) >> kShift;
  static constexpr uint32_t kLast = std::bit_cast<uint32_t>(1.0f) >> kShift;

  std::array<uint8_t, kLast - kFirst> code_at_lower_edge;
  std::array<float, 257> first_of_code;  ///< the smallest float of each code; infinite beyond the last

  CodeTable() {
    for (int code = 1; code < 256; ++code) {
      // The inverse lands within a few floats of the boundary: walk to the first that rounds up.
      float x = static_cast<float>(linear_from_srgb((code - 0.5) / 255));
      while (rounds_to(x) >= code) x = std::nextafter(x, 0.0f);
      while (rounds_to(x) < code) x = std::nextafter(x, 2.0f);
      first_of_code[code] = x;
    }
    first_of_code[0] = 0;
    first_of_code[256] = std::numeric_limits<float>::infinity();
    for (uint32_t key = kFirst; key < kLast; ++key)
      code_at_lower_edge[key - kFirst] = static_cast<uint8_t>(rounds_to(std::bit_cast<float>(key << kShift)));
  }

  static int rounds_to(float linear) { return static_cast<int>(std::floor(srgb_from_linear(linear) * 255 + 0.5)); }
};

const CodeTable& code_table() {
  static const CodeTable table;
  return table;
}

uint8_t look_up(const CodeTable& table, float linear) {
  if (!(linear >= 0x1p-13f)) return 0;
  if (linear >= 1) return 255;
  const uint8_t code = table.code_at_lower_edge[(std::bit_cast<uint32_t>(linear) >> table.kShift) - table.kFirst];
  return static_cast<uint8_t>(code + (linear >= table.first_of_code[code + 1]));
}

uint8_t code_of_share(float share) {
  if (!(share > 0)) return 0;
  return share >= 1 ? 255 : static_cast<uint8_t>(share * 255.0f + 0.5f);
}

}  // namespace

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double display) {
  return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

uint8_t srgb8_from_linear(float linear) { return look_up(code_table(), linear); }

int alpha_channel(int channels) { return channels == 2 || channels == 4 ? channels - 1 : -1; }

std::vector<uint8_t> srgb8_from_linear(const Image& image) {
  const CodeTable& table = code_table();
  const int alpha = alpha_channel(image.channels);
  std::vector<uint8_t> codes(image.data.size());
  for (size_t i = 0; i < codes.size(); ++i) codes[i] = look_up(table, image.data[i]);
  if (alpha >= 0)
    for (size_t i = alpha; i < codes.size(); i += image.channels) codes[i] = code_of_share(image.data[i]);
  return codes;
}

Image linear_from_srgb(Image image) {
  const int alpha = alpha_channel(image.channels);
  for (size_t i = 0; i < image.data.size(); ++i)
    if (static_cast<int>(i % image.channels) != alpha)
      image.data[i] = static_cast<float>(linear_from_srgb(image.data[i]));
  return image;
}

}  // namespace hybridrt
