#include "core/golden/golden.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/error.h"
#include "core/base/input_file.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr size_t kLargestList = size_t{64} << 20;

GoldenCase parse_case(const json& entry, const fs::path& list) {
  static const std::set<std::string> kKeys = {"name",         "scene",     "options", "fail",
                                              "fail_percent", "hard_fail", "reason"};
  GoldenCase golden;
  golden.name = entry.at("name").get<std::string>();
  for (const auto& [key, value] : entry.items())
    if (!kKeys.contains(key))
      throw error(ErrorKind::input, "{}: case '{}': unknown key '{}'", list.string(), golden.name, key);
  golden.scene = entry.at("scene").get<std::string>();
  golden.options = entry.value("options", std::vector<std::string>{});
  golden.limits.fail = entry.value("fail", golden.limits.fail);
  golden.limits.fail_percent = entry.value("fail_percent", golden.limits.fail_percent);
  golden.limits.hard_fail = entry.value("hard_fail", golden.limits.hard_fail);
  golden.reason = entry.at("reason").get<std::string>();
  const CompareLimits& l = golden.limits;
  if (!(l.fail >= 0 && l.fail <= 1 && l.hard_fail >= 0 && l.hard_fail <= 1 && l.fail_percent >= 0 &&
        l.fail_percent <= 100))
    throw error(ErrorKind::input, "{}: case '{}': fail and hard_fail are 0 to 1, fail_percent 0 to 100", list.string(),
                golden.name);
  if (golden.name.empty() || golden.name.find('/') != std::string::npos)
    throw error(ErrorKind::input, "{}: '{}' cannot be a case's name; it becomes a file name", list.string(),
                golden.name);
  return golden;
}

std::string resolve_scene(const std::string& scene, const fs::path& folder) {
  if (scene.starts_with("scene:") || fs::path(scene).is_absolute()) return scene;
  const fs::path beside = folder / scene, above = folder / ".." / scene;
  return (fs::exists(beside) || !fs::exists(above) ? beside : above).lexically_normal().string();
}

}  // namespace

GoldenList read_golden_list(const fs::path& path) {
  std::error_code unreachable;
  if (!fs::exists(path, unreachable) || fs::is_directory(path, unreachable))
    throw error(ErrorKind::input, "{}: no such golden list; name one by --list", path.string());
  const std::string text = read_whole_file(path, kLargestList);
  if (text.size() > kLargestList)
    throw error(ErrorKind::input, "{} is larger than {} MiB; is it a golden list?", path.string(), kLargestList >> 20);
  GoldenList list;
  list.folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  try {
    json document;
    try {
      document = json::parse(text);
    } catch (const json::exception& problem) {
      throw error(ErrorKind::input, "{}: not a golden list: {}", path.string(), problem.what());
    }
    if (!document.is_object() || !document.contains("cases") || !document["cases"].is_array())
      throw error(ErrorKind::input, "{}: not a golden list: write {{\"cases\": [...]}}", path.string());
    for (const auto& [key, value] : document.items())
      if (key != "cases") throw error(ErrorKind::input, "{}: unknown key '{}'", path.string(), key);
    for (const json& entry : document["cases"]) list.cases.push_back(parse_case(entry, path));
  } catch (const json::exception& problem) {
    throw error(ErrorKind::input, "{}: not a golden list: case {}: {}", path.string(), list.cases.size() + 1,
                problem.what());
  }
  std::set<std::string> names;
  for (GoldenCase& golden : list.cases) {
    if (!names.insert(golden.name).second)
      throw error(ErrorKind::input, "{}: two cases are called '{}'", path.string(), golden.name);
    golden.scene = resolve_scene(golden.scene, list.folder);
  }
  if (list.cases.empty()) throw error(ErrorKind::input, "{}: the list has no cases", path.string());
  return list;
}

void keep_cases(GoldenList& list, std::span<const std::string> names) {
  for (const std::string& name : names)
    if (std::none_of(list.cases.begin(), list.cases.end(), [&](const GoldenCase& c) { return c.name == name; }))
      throw error(ErrorKind::usage, "there is no golden case '{}' in the list", name);
  if (names.empty()) return;
  std::erase_if(list.cases, [&](const GoldenCase& golden) {
    return std::find(names.begin(), names.end(), golden.name) == names.end();
  });
}

std::string GoldenResult::verdict() const {
  if (!failure.empty()) return failure;
  if (!compared.measured) return compared.reason;
  const std::string numbers = fmt::format("max error {:.4f}, {:.3f} % of the pixels over {}", compared.max_error,
                                          compared.percent_over_fail(), golden.limits.fail);
  return compared.same ? numbers : compared.reason + " (" + numbers + ")";
}

}  // namespace hybridrt
