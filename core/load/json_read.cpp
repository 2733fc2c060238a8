#include "core/load/json_read.h"

#include <algorithm>
#include <string_view>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/warnings.h"
#include "core/load/text_scan.h"

namespace hybridrt {
namespace {

using nlohmann::json;

struct Position {
  size_t line = 1, column = 1;
};

/// Line and column of the byte that the parser stopped at (counted from 1; one past the end where the text is cut
/// short).
Position position_of(std::string_view text, size_t byte) {
  Position position;
  const size_t end = std::min(byte > 0 ? byte - 1 : 0, text.size());
  for (size_t i = 0; i < end; ++i) {
    if (text[i] == '\n') ++position.line, position.column = 0;
    ++position.column;
  }
  return position;
}

/// The library's message without its position: what follows "column N: ", or else "[…] ".
std::string_view reason(std::string_view message) {
  const size_t column = message.find("column ");
  const size_t colon = column == message.npos ? message.npos : message.find(": ", column);
  if (colon != message.npos) return message.substr(colon + 2);
  const size_t bracket = message.find("] ");
  return bracket == message.npos ? message : message.substr(bracket + 2);
}

}  // namespace

json read_json_file(const std::filesystem::path& path) {
  const std::string text = read_whole_file(path, kLargestJson);
  if (text.size() > kLargestJson)
    throw error(ErrorKind::input, "{} is larger than {} MiB; is it a JSON file?", path.string(), kLargestJson >> 20);
  try {
    return json::parse(text);
  } catch (const json::parse_error& problem) {
    const Position at = position_of(text, problem.byte);
    throw error(ErrorKind::input, "{}:{}:{}: not JSON: {}; fix the text there", path.string(), at.line, at.column,
                in_quotes(reason(problem.what())));
  } catch (const json::exception& problem) {  // a number beyond double's range
    throw error(ErrorKind::input, "{}: a number is too large: {}; write a smaller one", path.string(),
                in_quotes(reason(problem.what())));
  }
}

void JsonPlace::fail(const std::string& problem) const { throw error(ErrorKind::input, "{}: {}", where_, problem); }

void JsonPlace::only_object() const {
  if (!value_->is_object()) fail("must be an object, like {\"name\": …}");
}

void JsonPlace::only(std::initializer_list<const char*> keys) const {
  only_object();
  for (const auto& [key, ignored] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), std::string_view(key)) != keys.end()) continue;
    std::string known;
    for (const char* name : keys) known += (known.empty() ? "" : ", ") + std::string(name);
    fail(fmt::format("unknown key {}; known are {}", in_quotes(key), known));
  }
}

bool JsonPlace::has(const char* key) const {
  only_object();
  return value_->contains(key);
}

JsonPlace JsonPlace::at(const char* key) const {
  if (!has(key)) fail(fmt::format("'{}' is missing; add it here", key));
  const bool top = where_.find(": ") == where_.npos;
  return {value_->at(key), where_ + (top ? ": " : ".") + key};
}

std::optional<JsonPlace> JsonPlace::find(const char* key) const {
  return has(key) ? std::optional<JsonPlace>(at(key)) : std::nullopt;
}

size_t JsonPlace::size() const {
  if (!value_->is_array()) fail("must be an array, like [ … ]");
  return value_->size();
}

JsonPlace JsonPlace::operator[](size_t index) const {
  return {value_->at(index), fmt::format("{}[{}]", where_, index)};
}

double JsonPlace::number() const {
  if (!value_->is_number()) fail("must be a number");
  const double number = value_->get<double>();
  if (!std::isfinite(number)) fail("must be a finite number");
  return number;
}

bool JsonPlace::boolean() const {
  if (!value_->is_boolean()) fail("must be true or false");
  return value_->get<bool>();
}

std::string JsonPlace::text() const {
  if (!value_->is_string()) fail("must be a string in double quotes");
  return value_->get<std::string>();
}

dvec3 JsonPlace::vector() const {
  if (!value_->is_array() || value_->size() != 3) fail("must be three numbers, like [1, 2.5, -3]");
  dvec3 v(0);
  for (int axis = 0; axis < 3; ++axis) {
    v[axis] = (*this)[static_cast<size_t>(axis)].number();
    if (std::abs(v[axis]) >= 1e30) (*this)[static_cast<size_t>(axis)].fail("must be below 1e30");
  }
  return v;
}

dvec3 JsonPlace::direction() const {
  const dvec3 v = vector();
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0)) fail("must not be zero: it is a direction");
  return largest > 1e-100 ? v : v / largest;  // squares of the smallest numbers underflow
}

}  // namespace hybridrt
