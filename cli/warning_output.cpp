#include "cli/warning_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/standard_streams.h"
#include "core/base/error.h"

namespace hybridrt::cli {

std::string text_of(const Warning& warning) {
  return fmt::format("{} [{}]", in_one_line(warning.text), name_of(warning.code));
}

std::string line_of(const Warning& warning) { return "hybridrt: warning: " + text_of(warning); }

void warn(const Warning& warning) { say(line_of(warning) + "\n"); }

nlohmann::ordered_json json_of(const Warning& warning) {
  return {{"code", name_of(warning.code)}, {"message", warning.text}};
}

nlohmann::ordered_json json_of(const Warnings& warnings) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Warning& warning : warnings) all.push_back(json_of(warning));
  return all;
}

}  // namespace hybridrt::cli
