#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace hybridrt {

/// A value and the name that users write and read for it. Such names are kept in tables of these and nowhere else.
template <typename Value>
struct Named {
  std::string_view name;
  Value value;
};

/// The value's name; "?" for one that the table lacks.
template <typename Value, size_t N>
constexpr std::string_view name_in(const Named<Value> (&table)[N], Value value) {
  for (const Named<Value>& entry : table)
    if (entry.value == value) return entry.name;
  return "?";
}

template <typename Value, size_t N>
constexpr std::optional<Value> value_in(const Named<Value> (&table)[N], std::string_view name) {
  for (const Named<Value>& entry : table)
    if (entry.name == name) return entry.value;
  return std::nullopt;
}

/// "hybrid, raster, raytrace", for messages and help.
template <typename Value, size_t N>
std::string names_in(const Named<Value> (&table)[N]) {
  std::string list;
  for (const Named<Value>& entry : table) list.append(list.empty() ? "" : ", ").append(entry.name);
  return list;
}

}  // namespace hybridrt
