#include "cli/option_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/base/memory.h"

namespace hybridrt::cli {
namespace {

const std::map<std::string, uint32_t> kAovs = {{"id", kAovId},         {"shadow", kAovShadow}, {"marked", kAovMarked},
                                               {"traced", kAovTraced}, {"depth", kAovDepth},   {"normal", kAovNormal}};

template <typename Number>
bool parse_number(std::string_view text, Number& out) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), out);
  return problem == std::errc{} && end == text.data() + text.size();
}

}  // namespace

dvec3 parse_vector(const char* option, const std::string& text) {
  dvec3 v(0);
  const size_t first = text.find(','), second = text.find(',', first + 1);
  const std::string_view whole = text;
  if (first == std::string::npos || second == std::string::npos || !parse_number(whole.substr(0, first), v.x) ||
      !parse_number(whole.substr(first + 1, second - first - 1), v.y) || !parse_number(whole.substr(second + 1), v.z) ||
      !all_finite(v))
    throw error(ErrorKind::usage, "{} {}: write three numbers, like 1,2.5,-3", option, text);
  return v;
}

void parse_size(const std::string& text, RenderSettings& settings) {
  const size_t cross = text.find('x');
  int width = 0, height = 0;
  if (cross == std::string::npos || !parse_number(std::string_view(text).substr(0, cross), width) ||
      !parse_number(std::string_view(text).substr(cross + 1), height) || width < 1 || height < 1 ||
      width > kLargestSide_px || height > kLargestSide_px)
    throw error(ErrorKind::usage, "--size {}: write WIDTHxHEIGHT, each 1 to {}, like 1024x768", text, kLargestSide_px);
  settings.width_px = width;
  settings.height_px = height;
}

void parse_crop(const std::string& text, RenderSettings& settings) {
  int numbers[4] = {};
  std::string_view rest = text;
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    const size_t comma = i < 3 ? rest.find(',') : rest.size();
    good = comma != rest.npos && parse_number(rest.substr(0, comma), numbers[i]);
    if (good && i < 3) rest.remove_prefix(comma + 1);
  }
  if (!good) throw error(ErrorKind::usage, "--crop {}: write X,Y,W,H in pixels, like 100,50,320,240", text);
  const PixelRect crop{numbers[0], numbers[1], numbers[2], numbers[3]};
  if (crop.x_px < 0 || crop.y_px < 0 || crop.width_px < 1 || crop.height_px < 1 ||
      crop.x_px > settings.width_px - crop.width_px || crop.y_px > settings.height_px - crop.height_px)
    throw error(ErrorKind::usage, "--crop {}: it must lie inside the frame of {}x{} pixels", text, settings.width_px,
                settings.height_px);
  settings.crop = crop;
}

uint32_t parse_aovs(const std::string& text) {
  uint32_t bits = 0;
  for (size_t begin = 0; !text.empty() && begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    const auto found = kAovs.find(name);
    if (found == kAovs.end()) throw error(ErrorKind::usage, "--aov {}: not known; any of {}", name, names(kAovs));
    bits |= found->second;
    begin = end + 1;
  }
  return bits;
}

uint64_t parse_max_memory(const std::string& text) {
  if (text.empty()) return allowed_memory();
  if (text == "none") return std::numeric_limits<uint64_t>::max();
  constexpr std::string_view kUnits = "KMGT";
  double bytes = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, bytes);
  std::string_view rest(stop, static_cast<size_t>(end - stop));
  if (!rest.empty() && kUnits.find(rest.front()) != kUnits.npos) {
    bytes *= std::exp2(10.0 * static_cast<double>(1 + kUnits.find(rest.front())));
    rest.remove_prefix(1);
    if (rest == "B" || rest == "iB") rest = {};
  }
  if (status != std::errc() || !rest.empty() || !(bytes >= 1 && bytes < 1e18))
    throw error(ErrorKind::usage, "--max-memory {}: write a number with K, M, G or T behind it, like 8G, or none",
                text);
  return static_cast<uint64_t>(bytes);
}

void require_range(const char* option, long long value, long long lowest, long long highest) {
  if (value < lowest || value > highest)
    throw error(ErrorKind::usage, "{} {}: allowed are {} to {}", option, value, lowest, highest);
}

}  // namespace hybridrt::cli
