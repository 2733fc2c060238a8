#include "core/render/frame_spec.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/error.h"

namespace hybridrt {
namespace {

constexpr const char* kAllowed = "write 100 (frames 1-100), 1-100, 1-100:5, or a list like 1-10,20,30-40";

int64_t count_of(const FrameRange& range) { return (int64_t{range.last} - range.first) / range.step + 1; }

int last_frame(const FrameRange& range) { return static_cast<int>(range.first + (count_of(range) - 1) * range.step); }

int parse_number(std::string_view digits, const std::string& whole) {
  int value = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (problem != std::errc{} || end != digits.data() + digits.size() || value < 0 || digits.front() == '-')
    throw error(ErrorKind::usage, "frames '{}': '{}' is not a frame number; {}", whole, digits, kAllowed);
  return value;
}

FrameRange parse_range(std::string_view item, const std::string& whole) {
  FrameRange range;
  std::string_view bounds = item;
  if (const size_t colon = item.find(':'); colon != std::string_view::npos) {
    range.step = parse_number(item.substr(colon + 1), whole);
    bounds = item.substr(0, colon);
    if (range.step < 1) throw error(ErrorKind::usage, "frames '{}': the step must be at least 1", whole);
  }
  const size_t dash = bounds.find('-', 1);
  range.first = parse_number(bounds.substr(0, dash), whole);
  range.last = dash == std::string_view::npos ? range.first : parse_number(bounds.substr(dash + 1), whole);
  if (range.last < range.first)
    throw error(ErrorKind::usage, "frames '{}': {} comes before {}; write the lower frame first", whole, range.last,
                range.first);
  return range;
}

/// x with a * x = 1 modulo m; a and m have no common factor. Extended Euclid.
int64_t inverse(int64_t a, int64_t m) {
  int64_t x = 1, next_x = 0, r = a % m, next_r = m;
  while (next_r != 0) {
    const int64_t quotient = r / next_r;
    x = std::exchange(next_x, x - quotient * next_x);
    r = std::exchange(next_r, r - quotient * next_r);
  }
  return (x % m + m) % m;
}

/// True if some frame is in both. By the Chinese remainder theorem the frames in both are `common`, then every
/// lcm(steps)-th.
bool overlap(const FrameRange& a, const FrameRange& b) {
  const int64_t divisor = std::gcd(a.step, b.step), apart = int64_t{b.first} - a.first;
  if (apart % divisor != 0) return false;
  const int64_t modulus = b.step / divisor, cycle = a.step * modulus;
  const int64_t steps =
      ((apart / divisor) % modulus + modulus) % modulus * inverse(a.step / divisor, modulus) % modulus;
  const int64_t begin = std::max(a.first, b.first), end = std::min(last_frame(a), last_frame(b));
  int64_t common = a.first + steps * a.step;
  if (common < begin) common += (begin - common + cycle - 1) / cycle * cycle;
  return common <= end;
}

}  // namespace

int64_t FrameSpec::count() const {
  int64_t count = 0;
  for (const FrameRange& range : ranges) count += count_of(range);
  return count;
}

int FrameSpec::lowest() const {
  return std::min_element(ranges.begin(), ranges.end(), [](auto& a, auto& b) { return a.first < b.first; })->first;
}

int FrameSpec::highest() const {
  int highest = 0;
  for (const FrameRange& range : ranges) highest = std::max(highest, last_frame(range));
  return highest;
}

FrameSpec parse_frame_spec(const std::string& text) {
  FrameSpec spec;
  spec.ranges.clear();
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    if (end == begin) throw error(ErrorKind::usage, "frames '{}': an empty entry; {}", text, kAllowed);
    spec.ranges.push_back(parse_range(std::string_view(text).substr(begin, end - begin), text));
    begin = end + 1;
  }
  if (text.find_first_of("-,:") == std::string::npos) {  // a lone N is a count
    if (spec.ranges[0].last < 1) throw error(ErrorKind::usage, "frames '{}': at least 1 is needed", text);
    spec.ranges[0].first = 1;
  }
  for (size_t i = 0; i < spec.ranges.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (overlap(spec.ranges[j], spec.ranges[i]))
        throw error(ErrorKind::usage, "frames '{}': two of the ranges overlap; name every frame once", text);
  return spec;
}

FrameSpec spec_of(const std::vector<int>& frames) {
  FrameSpec spec;
  spec.ranges.clear();
  for (size_t begin = 0; begin < frames.size();) {
    size_t last = begin + 1;
    const int step = last < frames.size() ? frames[last] - frames[begin] : 1;
    while (last + 1 < frames.size() && frames[last + 1] - frames[last] == step) ++last;
    const bool is_range = last < frames.size() && (step == 1 || last - begin > 1);  // two apart are two frames
    if (!is_range) last = begin;
    spec.ranges.push_back({frames[begin], frames[last], is_range ? step : 1});
    begin = last + 1;
  }
  return spec;
}

namespace {

/// How frames are written.
struct RangeStyle {
  char between_ranges, before_step;
  int digits;  ///< of each number, at least
};

std::string written(const FrameSpec& spec, const RangeStyle& style) {
  std::string text;
  for (const FrameRange& range : spec.ranges) {
    if (!text.empty()) text += style.between_ranges;
    text += fmt::format("{:0{}}", range.first, style.digits);
    if (count_of(range) > 1 || spec.ranges.size() == 1) text += fmt::format("-{:0{}}", last_frame(range), style.digits);
    if (count_of(range) > 1 && range.step > 1) text += fmt::format("{}{}", style.before_step, range.step);
  }
  return text;
}

}  // namespace

std::string text_of(const FrameSpec& spec) { return written(spec, {',', ':', 1}); }

std::string name_part_of(const FrameSpec& spec) {
  const std::string name = written(spec, {'+', 'x', 4});
  constexpr size_t kLongest = 60;
  if (name.size() <= kLongest) return name;
  uint64_t hash = 0xcbf29ce484222325ull;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return fmt::format("{:04}-{:04}+{:016x}", spec.lowest(), spec.highest(), hash);
}

FrameRange parse_sequence(const std::string& text) {
  if (text.find('-', 1) == std::string::npos || text.find_first_of(",:") != std::string::npos)
    throw error(ErrorKind::usage, "--sequence '{}': write the first and the last frame, like 1-100", text);
  return parse_range(text, text);
}

std::optional<int> FrameCursor::next() {
  if (range_ == spec_.ranges.size()) return std::nullopt;
  const FrameRange& range = spec_.ranges[range_];
  const int frame = static_cast<int>(range.first + offset_ * range.step);
  if (++offset_ == count_of(range)) {
    ++range_;
    offset_ = 0;
  }
  return frame;
}

}  // namespace hybridrt
