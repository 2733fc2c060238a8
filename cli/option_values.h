#pragma once

#include <functional>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/render/settings.h"

namespace hybridrt::cli {

// What options' values mean. Every function throws Error(usage) that names the option and says what is allowed.

constexpr int kLargestSide_px = 65536;

/// Three finite numbers between commas.
dvec3 parse_vector(const char* option, const std::string& text);

/// WIDTHxHEIGHT into `settings`.
void parse_size(const std::string& text, RenderSettings& settings);

/// X,Y,W,H into `settings`, whose size is already known.
void parse_crop(const std::string& text, RenderSettings& settings);

/// Names between commas; the bits of kAovId and so on.
uint32_t parse_aovs(const std::string& text);

/// Bytes: a number and K, M, G or T (of 1024), with or without B or iB behind it. "none" is no limit, nothing what the
/// machine or its cgroup has.
uint64_t parse_max_memory(const std::string& text);

void require_range(const char* option, long long value, long long lowest, long long highest);

template <typename Value>
std::string names(const std::map<std::string, Value>& table) {
  std::string list;
  for (const auto& [name, value] : table) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Reads the value by name; CLI11's own messages would show C++ type names.
template <typename Value>
std::function<void(const std::string&)> by_name(const char* option, const std::map<std::string, Value>& table,
                                                Value& out) {
  return [option, &table, &out](const std::string& text) {
    const auto found = table.find(text);
    if (found == table.end()) throw error(ErrorKind::usage, "{} {}: not known; one of {}", option, text, names(table));
    out = found->second;
  };
}

}  // namespace hybridrt::cli
