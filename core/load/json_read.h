#pragma once

#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/base/math.h"

namespace hybridrt {

/// Largest JSON file that is read: enough for a camera path of half a million keys.
inline constexpr size_t kLargestJson = size_t{64} << 20;

/// Reads the whole file. Throws Error (input) if it is missing, a directory, too large, or not JSON (with line and
/// column).
nlohmann::json read_json_file(const std::filesystem::path& path);

/// A value of a JSON document that knows its place in it, so that every error names that place ("shot.json:
/// keyframes[3].eye: …"). Refers to the document, which must outlive it. Every function throws Error (input) when the
/// value is not of the wanted kind.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string where) : value_(&value), where_(std::move(where)) {}

  const nlohmann::json& value() const { return *value_; }
  const std::string& where() const { return where_; }
  void only_object() const;  ///< refuses anything but an object
  bool is_text() const { return value_->is_string(); }

  /// For objects. `only` refuses all other keys, naming the first.
  void only(std::initializer_list<const char*> keys) const;
  bool has(const char* key) const;
  JsonPlace at(const char* key) const;
  std::optional<JsonPlace> find(const char* key) const;

  /// For arrays.
  size_t size() const;
  JsonPlace operator[](size_t index) const;

  double number() const;  ///< finite
  std::string text() const;
  bool boolean() const;
  dvec3 vector() const;     ///< three numbers, each below 1e30
  dvec3 direction() const;  ///< a vector that is not zero, whose length squared is a usable number

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  const nlohmann::json* value_;
  std::string where_;
};

}  // namespace hybridrt
