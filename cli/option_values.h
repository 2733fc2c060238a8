#pragma once

#include <string>

#include "core/base/error.h"
#include "core/base/named.h"
#include "core/image_io/video_frame.h"
#include "core/render/settings.h"

namespace hybridrt::cli {

// Parsers of option values. Every function throws Error(usage), naming the option and what is allowed.

constexpr int kLargestSide_px = 65536;

/// A whole number from `lowest` to `highest`.
int parse_whole(const char* option, const std::string& text, int lowest, int highest);

/// Degrees, more than 0 and less than 180, as radians.
double parse_fov(const char* option, const std::string& text);

/// A number from 0 to 100.
double parse_percent(const char* option, const std::string& text);

/// Three finite numbers between commas.
dvec3 parse_vector(const char* option, const std::string& text);

/// The same, but not all zero.
dvec3 parse_direction(const char* option, const std::string& text);

/// Three linear intensities, at least 0, between commas.
vec3 parse_color(const char* option, const std::string& text);

/// Stores WIDTHxHEIGHT in `settings`.
void parse_size(const char* option, const std::string& text, RenderSettings& settings);

/// X,Y,W,H. finished_settings() checks that it lies inside the frame.
PixelRect parse_crop(const char* option, const std::string& text);

/// Names between commas; the bits of kAovId and so on.
uint32_t parse_aovs(const char* option, const std::string& text);

/// Bytes: a number followed by K, M, G or T (powers of 1024), optionally with B or iB. "none" is no limit.
uint64_t parse_bytes(const char* option, const std::string& text);

/// A whole number from 1 to a million, or two with a stroke between them: 25, 30000/1001.
FrameRate parse_frame_rate(const char* option, const std::string& text);

/// "true" or "false".
bool parse_flag(const char* option, const std::string& text);

/// One of the table's names.
template <typename Value, size_t N>
Value parse_name(const char* option, const Named<Value> (&table)[N], const std::string& text) {
  if (const auto value = value_in(table, text)) return *value;
  throw error(ErrorKind::usage, "{} {}: not known; must be one of {}", option, text, names_in(table));
}

}  // namespace hybridrt::cli
