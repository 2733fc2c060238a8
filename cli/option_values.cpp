#include "cli/option_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace hybridrt::cli {
namespace {

template <typename Number>
bool parse_number(std::string_view text, Number& out) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), out);
  return problem == std::errc{} && end == text.data() + text.size();
}

}  // namespace

int parse_whole(const char* option, const std::string& text, int lowest, int highest) {
  int value = 0;
  if (!parse_number(text, value) || value < lowest || value > highest)
    throw error(ErrorKind::usage, "{} {}: must be a whole number from {} to {}", option, text, lowest, highest);
  return value;
}

double parse_fov(const char* option, const std::string& text) {
  double degrees = 0;
  if (!parse_number(text, degrees) || !(degrees > 0 && degrees < 180))
    throw error(ErrorKind::usage, "{} {}: must be more than 0 and less than 180 degrees", option, text);
  return degrees * kPi / 180;
}

FrameRate parse_frame_rate(const char* option, const std::string& text) {
  constexpr int kMost = 1'000'000;
  const size_t stroke = std::min(text.find('/'), text.size());
  FrameRate rate;
  const bool per_given = stroke < text.size();
  if (!parse_number(text.substr(0, stroke), rate.count) || rate.count < 1 || rate.count > kMost ||
      (per_given && !parse_number(text.substr(stroke + 1), rate.per)) || rate.per < 1 || rate.per > kMost)
    throw error(ErrorKind::usage, "{} {}: must be a whole number, or two as in 30000/1001, from 1 to {}", option, text,
                kMost);
  return rate;
}

double parse_percent(const char* option, const std::string& text) {
  double percent = 0;
  if (!parse_number(text, percent) || !(percent >= 0 && percent <= 100))
    throw error(ErrorKind::usage, "{} {}: must be a number from 0 to 100", option, text);
  return percent;
}

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

dvec3 parse_direction(const char* option, const std::string& text) {
  const dvec3 v = parse_vector(option, text);
  if (v == dvec3(0)) throw error(ErrorKind::usage, "{} {}: it must not be zero", option, text);
  return v;
}

void parse_size(const char* option, const std::string& text, RenderSettings& settings) {
  const size_t cross = text.find('x');
  int width = 0, height = 0;
  if (cross == std::string::npos || !parse_number(std::string_view(text).substr(0, cross), width) ||
      !parse_number(std::string_view(text).substr(cross + 1), height) || width < 1 || height < 1 ||
      width > kLargestSide_px || height > kLargestSide_px)
    throw error(ErrorKind::usage, "{} {}: write WIDTHxHEIGHT, each from 1 to {}, like 1024x768", option, text,
                kLargestSide_px);
  settings.width_px = width;
  settings.height_px = height;
}

vec3 parse_color(const char* option, const std::string& text) {
  const dvec3 color = parse_vector(option, text);
  for (int i = 0; i < 3; ++i)
    if (!(color[i] >= 0 && color[i] <= 1e6))
      throw error(ErrorKind::usage, "{} {}: write three linear intensities, 0 or more, like 1,1,1 for white", option,
                  text);
  return vec3(color);
}

PixelRect parse_crop(const char* option, const std::string& text) {
  int numbers[4] = {};
  std::string_view rest = text;
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    const size_t comma = i < 3 ? rest.find(',') : rest.size();
    good = comma != rest.npos && parse_number(rest.substr(0, comma), numbers[i]);
    if (good && i < 3) rest.remove_prefix(comma + 1);
  }
  if (!good) throw error(ErrorKind::usage, "{} {}: write X,Y,W,H in pixels, like 100,50,320,240", option, text);
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

uint32_t parse_aovs(const char* option, const std::string& text) {
  uint32_t bits = 0;
  for (size_t begin = 0; !text.empty() && begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    bits |= parse_name(option, kAovs, text.substr(begin, end - begin));
    begin = end + 1;
  }
  return bits;
}

uint64_t parse_bytes(const char* option, const std::string& text) {
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
    throw error(ErrorKind::usage, "{} {}: write a number followed by K, M, G or T, like 8G, or none", option, text);
  return static_cast<uint64_t>(bytes);
}

bool parse_flag(const char* option, const std::string& text) {
  if (text != "true" && text != "false")
    throw error(ErrorKind::usage, "{} {}: it takes no value; in a file write true or false", option, text);
  return text == "true";
}

}  // namespace hybridrt::cli
