#pragma once

#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/base/math.h"

namespace hybridrt {

/// Largest JSON file that is read: a camera path of half a million keys.
inline constexpr size_t kLargestJson = size_t{64} << 20;

/// The whole file. Throws Error (input): missing, a directory, too large, not JSON (with line and column).
nlohmann::json read_json_file(const std::filesystem::path& path);

/// A value of a JSON document that knows where it stands, so that every complaint names its place
/// ("shot.json: keyframes[3].eye: …"). Refers to the document, which must outlive it. Every function throws
/// Error (input) when the value is not what it is asked to be.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string where) : value_(&value), where_(std::move(where)) {}

  const nlohmann::json& value() const { return *value_; }
  const std::string& where() const { return where_; }
  void only_object() const;  ///< refuses all else
  bool is_text() const { return value_->is_string(); }

  /// Of an object. `only` refuses all keys but these, by name.
  void only(std::initializer_list<const char*> keys) const;
  bool has(const char* key) const;
  JsonPlace at(const char* key) const;
  std::optional<JsonPlace> find(const char* key) const;

  /// Of an array.
  size_t size() const;
  JsonPlace operator[](size_t index) const;

  double number() const;  ///< finite
  std::string text() const;
  dvec3 vector() const;     ///< three numbers, each below 1e30
  dvec3 direction() const;  ///< a vector that is not zero, whose length squared is a usable number

  [[noreturn]] void fail(const std::string& problem) const;

 private:
  const nlohmann::json* value_;
  std::string where_;
};

}  // namespace hybridrt
