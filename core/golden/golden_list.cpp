#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/golden/golden.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr size_t kLargestList = size_t{64} << 20;

/// The line that each entry of the only array of a valid list begins on, from 1.
std::vector<int> lines_of_cases(const std::string& text) {
  std::vector<int> lines;
  int line = 1, depth = 0;
  bool in_string = false, expects_entry = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    line += c == '\n';
    const bool is_space = c == ' ' || c == '\n' || c == '\t' || c == '\r';
    if (expects_entry && !is_space && c != ']') lines.push_back(line);
    if (!is_space) expects_entry = false;
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      expects_entry = ++depth == 2;
    } else if (c == '}' || c == ']') {
      --depth;
    } else if (c == ',' && depth == 2) {
      expects_entry = true;
    }
  }
  return lines;
}

/// What is wrong with the entries of a list, told together.
class Problems {
 public:
  explicit Problems(const fs::path& list) : list_(list) {}
  void begin_case(int line, std::string name) { line_ = line, name_ = std::move(name); }
  template <typename... Parts>
  void add(fmt::format_string<Parts...> text, Parts&&... parts) {
    all_ += fmt::format("{}{}:{}: {}: {}", all_.empty() ? "" : "; ", list_.string(), line_, name_,
                        fmt::format(text, std::forward<Parts>(parts)...));
  }
  void throw_if_any() const {
    if (!all_.empty()) throw Error(ErrorKind::input, all_);
  }

 private:
  const fs::path& list_;
  int line_ = 0;
  std::string name_, all_;
};

std::string text_in(const ordered_json& entry, const char* key, Problems& problems) {
  if (!entry.contains(key))
    problems.add("'{}' is missing", key);
  else if (!entry[key].is_string())
    problems.add("'{}' must be a text", key);
  else
    return entry[key];
  return "";
}

void take_number(const ordered_json& entry, const char* key, double most, double& value, Problems& problems) {
  if (!entry.contains(key)) return;
  if (entry[key].is_number() && entry[key] >= 0 && entry[key] <= most)
    value = entry[key];
  else
    problems.add("'{}' must be a number from 0 to {:g}", key, most);
}

bool take_limit(const ordered_json& entry, const std::string& key, CompareLimits& limits, Problems& problems) {
  if (key != "fail" && key != "fail_percent" && key != "hard_fail") return false;
  take_number(entry, "fail", 1, limits.fail, problems);
  take_number(entry, "fail_percent", 100, limits.fail_percent, problems);
  take_number(entry, "hard_fail", 1, limits.hard_fail, problems);
  return true;
}

/// Limits of one class of renderer.
void take_limits_on(const ordered_json& entry, RendererClass where, GoldenCase& golden, Problems& problems) {
  const std::string key = fmt::format("on_{}", name_in(kRendererClasses, where));
  if (!entry.contains(key)) return;
  if (!entry[key].is_object()) return problems.add("'{}' must be limits: {{\"fail\": ...}}", key);
  for (const auto& [name, value] : entry[key].items())
    if (!take_limit(entry[key], name, golden.limits[static_cast<size_t>(where)], problems))
      problems.add("{}: unknown key '{}'", key, name);
}

GoldenCase parse_case(const ordered_json& entry, Problems& problems) {
  static const std::set<std::string> kKeys = {"name",         "scene",          "options",       "fail",
                                              "fail_percent", "hard_fail",      "reason",        "budget",
                                              "on_cpu",       "on_software_gl", "on_hardware_gl"};
  GoldenCase golden;
  for (const auto& [key, value] : entry.items())
    if (!kKeys.contains(key)) problems.add("unknown key '{}'", key);
  golden.name = text_in(entry, "name", problems);
  golden.scene = text_in(entry, "scene", problems);
  golden.reason = text_in(entry, "reason", problems);
  if (entry.contains("name") && golden.name.empty()) problems.add("'name' is empty");
  if (golden.name.find('/') != std::string::npos) problems.add("'name' becomes a file name, it has no '/'");
  const ordered_json options = entry.value("options", ordered_json::array());
  if (options.is_array() && std::ranges::all_of(options, [](const auto& option) { return option.is_string(); }))
    golden.options = options;
  else
    problems.add("'options' must be texts: [\"--fov\", \"30\"]");
  CompareLimits limits;
  for (const char* key : {"fail", "fail_percent", "hard_fail"})
    if (entry.contains(key) && take_limit(entry, key, limits, problems)) break;
  golden.limits.fill(limits);
  for (const auto& where : kRendererClasses) take_limits_on(entry, where.value, golden, problems);
  if (entry.contains("budget")) take_number(entry, "budget", 1e9, golden.budget.emplace(), problems);
  return golden;
}

std::string resolve_scene(const std::string& scene, const fs::path& folder) {
  if (scene.starts_with("scene:") || fs::path(scene).is_absolute()) return scene;
  const fs::path beside = folder / scene, above = folder / ".." / scene;
  return (fs::exists(beside) || !fs::exists(above) ? beside : above).lexically_normal().string();
}

/// A list as JSON: its only key has an array.
ordered_json parse_list(const std::string& text, const fs::path& path) {
  ordered_json document;
  try {
    document = ordered_json::parse(text);
  } catch (const ordered_json::exception& problem) {
    throw error(ErrorKind::input, "{}: not a golden list: {}", path.string(), problem.what());
  }
  if (!document.is_object() || !document.contains("cases") || !document["cases"].is_array())
    throw error(ErrorKind::input, "{}: not a golden list: write {{\"cases\": [...]}}", path.string());
  for (const auto& [key, value] : document.items())
    if (key != "cases") throw error(ErrorKind::input, "{}: unknown key '{}'", path.string(), key);
  return document;
}

}  // namespace

GoldenList read_golden_list(const fs::path& path) {
  std::error_code unreachable;
  if (!fs::exists(path, unreachable) || fs::is_directory(path, unreachable))
    throw error(ErrorKind::input, "{}: no such golden list; name one by --list, or make one: hybridrt golden init DIR",
                path.string());
  const std::string text = read_whole_file(path, kLargestList);
  if (text.size() > kLargestList)
    throw error(ErrorKind::input, "{} is larger than {} MiB; is it a golden list?", path.string(), kLargestList >> 20);
  GoldenList list;
  list.file = path;
  list.folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  const ordered_json document = parse_list(text, path);
  const std::vector<int> lines = lines_of_cases(text);
  Problems problems(path);
  std::set<std::string> names;
  size_t number = 0;
  for (const ordered_json& entry : document["cases"]) {
    const bool is_named = entry.is_object() && entry.contains("name") && entry["name"].is_string();
    problems.begin_case(
        number < lines.size() ? lines[number] : 1,
        is_named ? fmt::format("case '{}'", entry["name"].get<std::string>()) : fmt::format("case {}", number + 1));
    ++number;
    if (!entry.is_object()) {
      problems.add("must be an object");
      continue;
    }
    GoldenCase golden = parse_case(entry, problems);
    if (is_named && !names.insert(golden.name).second) problems.add("another case has this name");
    golden.scene = resolve_scene(golden.scene, list.folder);
    list.cases.push_back(std::move(golden));
  }
  problems.throw_if_any();
  if (list.cases.empty())
    throw error(ErrorKind::input, "{}: the list has no cases; 'hybridrt golden add NAME SCENE --list {}' adds one",
                path.string(), path.string());
  return list;
}

std::string with_golden_case(const std::string& text, const fs::path& list, const std::string& name,
                             const std::string& scene, const std::vector<std::string>& options,
                             const std::string& reason) {
  ordered_json document = text.empty() ? ordered_json{{"cases", ordered_json::array()}} : parse_list(text, list);
  for (const ordered_json& entry : document["cases"])
    if (entry.is_object() && entry.contains("name") && entry["name"] == name)
      throw error(ErrorKind::usage, "{} has a case '{}' already; 'hybridrt golden update --list {} {}' renders it anew",
                  list.string(), name, list.string(), name);
  document["cases"].push_back({{"name", name}, {"scene", scene}, {"options", options}, {"reason", reason}});
  return document.dump(1) + "\n";
}

}  // namespace hybridrt
