#include "core/image/srgb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace hybridrt {
namespace {

/// The top bits of the float select an entry of a table. They span 1/256 of its value, over which the curve rises by
/// less than half a code: the code is that of the lower end, or the next one from a place on that the rest of the bits
/// is held against. Below 2^-13 every code is 0.
class CodeTable {
 public:
  CodeTable() {
    for (uint32_t key = kFirst; key < kLast; ++key)
      entries_[key - kFirst] = static_cast<uint32_t>(rounds_to(std::bit_cast<float>(key << kShift))) * kSpan;
    for (int code = 1; code < 256; ++code) {
      // The inverse lands within a few floats of the boundary: walk to the first that rounds up.
      float x = static_cast<float>(linear_from_srgb((code - 0.5) / 255));
      while (rounds_to(x) >= code) x = std::nextafter(x, 0.0f);
      while (rounds_to(x) < code) x = std::nextafter(x, 2.0f);
      const uint32_t bits = std::bit_cast<uint32_t>(x);
      if (bits % kSpan > 0) entries_[(bits >> kShift) - kFirst] += kSpan - bits % kSpan;
    }
  }

  /// A value within the table. NaN, and what is below, becomes the first, whose code is 0; what is above becomes the
  /// last, whose code is 255.
  static float clamped(float linear) {
    constexpr float kLeast = 0x1p-13f, kMost = 0x1.fffffep-1f;
    const float raised = linear > kLeast ? linear : kLeast;
    return raised < kMost ? raised : kMost;
  }

  uint8_t code_of(float within) const {
    const uint32_t bits = std::bit_cast<uint32_t>(within);
    return static_cast<uint8_t>((entries_[(bits >> kShift) - kFirst] + bits % kSpan) / kSpan);
  }

 private:
  static constexpr uint32_t kShift = 15, kSpan = 1u << kShift;
  static constexpr uint32_t kFirst = std::bit_cast<uint32_t>(0x1p-13f) >> kShift;
  static constexpr uint32_t kLast = std::bit_cast<uint32_t>(1.0f) >> kShift;

  /// The code times kSpan, plus what the rest of the bits lacks at the next code's first float to carry into it.
  std::array<uint32_t, kLast - kFirst> entries_;

  static int rounds_to(float linear) { return static_cast<int>(std::floor(srgb_from_linear(linear) * 255 + 0.5)); }
};

const CodeTable& code_table() {
  static const CodeTable table;
  return table;
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

uint8_t srgb8_from_linear(float linear) { return code_table().code_of(CodeTable::clamped(linear)); }

int alpha_channel(int channels) { return channels == 2 || channels == 4 ? channels - 1 : -1; }

void srgb8_from_linear(std::span<const float> linear, int channels, uint8_t* codes) {
  const CodeTable& table = code_table();
  std::array<float, 512> within;  // clamped apart from the table, so that the compiler does it by vectors
  for (size_t begin = 0; begin < linear.size(); begin += within.size()) {
    const size_t count = std::min(within.size(), linear.size() - begin);
    for (size_t i = 0; i < count; ++i) within[i] = CodeTable::clamped(linear[begin + i]);
    for (size_t i = 0; i < count; ++i) codes[begin + i] = table.code_of(within[i]);
  }
  if (const int alpha = alpha_channel(channels); alpha >= 0)
    for (size_t i = alpha; i < linear.size(); i += channels) codes[i] = code_of_share(linear[i]);
}

std::vector<uint8_t> srgb8_from_linear(const Image& image) {
  std::vector<uint8_t> codes(image.data.size());
  srgb8_from_linear(image.data, image.channels, codes.data());
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
