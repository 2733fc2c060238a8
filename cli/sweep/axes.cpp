#include "cli/sweep/axes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>

#include "core/base/error.h"
#include "core/load/text_scan.h"

namespace hybridrt::cli {
namespace {

constexpr size_t kMostValues = 10'000;  // per axis

constexpr std::string_view kSceneAxis = "scene";

/// The scene that is made, if it is one.
const ProceduralScene* procedural_of(const std::string& scene) {
  constexpr std::string_view kPrefix = "scene:";
  if (!scene.starts_with(kPrefix)) return nullptr;
  return find_procedural(std::string_view(scene).substr(kPrefix.size(), scene.find(',') - kPrefix.size()));
}

std::vector<std::string> axis_names(const ProceduralScene* procedural) {
  std::vector<std::string> names = {std::string(kSceneAxis)};
  if (procedural)
    for (const SceneParameter& parameter : procedural->parameters) names.emplace_back(parameter.name);
  for (const RenderOption& option : render_option_table())
    if (option.affects != Affects::run) names.emplace_back(option.name + 2);
  return names;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// Appends the values of A:B, A:B:STEP or A:B:*F; false if `text` is not of that form.
bool append_range(const std::string& axis, const std::string& text, std::vector<std::string>& values) {
  std::vector<std::string> parts = split(text, ':');
  if (parts.size() != 2 && parts.size() != 3) return false;
  if (parts.size() == 2) parts.emplace_back("1");
  const bool multiplies = parts[2].starts_with('*');
  const auto first = parse_number(parts[0]), last = parse_number(parts[1]),
             step = parse_number(std::string_view(parts[2]).substr(multiplies));
  if (!first || !last || !step) return false;
  const bool ends = multiplies ? *step > 1 && *first > 0 : *step > 0;
  if (!ends || *last < *first)
    throw error(ErrorKind::usage,
                "--over {}={}: write FIRST:LAST:STEP with FIRST <= LAST and a step above 0, or *F, F > 1", axis, text);
  const double steps = multiplies ? std::log(*last / *first) / std::log(*step) : (*last - *first) / *step;
  if (steps > static_cast<double>(kMostValues))
    throw error(ErrorKind::usage, "--over {}={}: more than {} values", axis, text, kMostValues);
  for (int i = 0; i <= static_cast<int>(steps + 1e-9); ++i)
    values.push_back(fmt::format("{:.12g}", multiplies ? *first * std::pow(*step, i) : *first + i * *step));
  return true;
}

Affects affects_of(const std::string& axis) {
  for (const RenderOption& option : render_option_table())
    if (axis == option.name + 2) return option.affects;
  return Affects::scene;  // the scene, and its parameters
}

void apply(const Axis& axis, const std::string& value, RenderOptions& options) {
  if (axis.name == kSceneAxis)
    options.scene = value;
  else if (axis.is_parameter)
    options.scene += fmt::format(",{}={}", axis.name, value);  // the last one counts
  else
    set_render_option(options, "--" + axis.name, value);
}

/// The next combination, the last axis fastest; false after the last.
bool advance(std::vector<size_t>& indices, const std::vector<Axis>& axes) {
  for (size_t a = axes.size(); a-- > 0;) {
    if (++indices[a] < axes[a].values.size()) return true;
    indices[a] = 0;
  }
  return false;
}

}  // namespace

std::string Axis::column() const {
  std::string column = name;
  std::replace(column.begin(), column.end(), '-', '_');
  return column;
}

Axis parse_axis(const std::string& text, const std::string& scene) {
  const size_t equals = text.find('=');
  Axis axis;
  axis.name = text.substr(0, equals);
  const ProceduralScene* procedural = procedural_of(scene);
  const std::vector<std::string> names = axis_names(procedural);
  if (std::find(names.begin(), names.end(), axis.name) == names.end())
    throw error(ErrorKind::usage, "--over {}: there is no axis '{}'; there are: {}", text, axis.name,
                fmt::join(names, ", "));
  if (equals == text.npos || equals + 1 == text.size())
    throw error(ErrorKind::usage, "--over {}: has no values; write {}=VALUE,VALUE", text, axis.name);
  axis.is_parameter = procedural && procedural->parameter(axis.name);
  axis.affects = affects_of(axis.name);
  const std::string values = text.substr(equals + 1);
  for (const std::string& part : split(values, values.find(';') == values.npos ? ',' : ';'))
    if (!append_range(axis.name, part, axis.values)) axis.values.push_back(part);

  for (const std::string& value : axis.values) {
    RenderOptions trial;
    trial.scene = scene;
    apply(axis, value, trial);  // throws for a value that the option does not take
    if (axis.is_parameter || axis.name == kSceneAxis) parse_scene_source(trial.scene);
  }
  return axis;
}

SweepSettings make_sweep_settings(const RenderOptions& base, const std::vector<Axis>& axes) {
  std::map<std::string, std::shared_ptr<const SceneSource>> sources;
  std::optional<Error> first_refusal;
  SweepSettings result;
  std::vector<size_t> indices(axes.size(), 0);
  do {
    SweepSetting setting;
    setting.options = base;
    for (size_t a = 0; a < axes.size(); ++a) {
      const std::string& value = axes[a].values[indices[a]];
      apply(axes[a], value, setting.options);
      setting.values.push_back(value);
      if (axes[a].values.size() > 1)
        setting.label += fmt::format("{}{}={}", setting.label.empty() ? "" : " ", axes[a].name, value);
    }
    auto& source = sources[setting.options.scene];
    if (!source) source = std::make_shared<const SceneSource>(parse_scene_source(setting.options.scene));
    setting.source = source;
    setting.options = with_scene_settings(setting.options, *source);
    try {
      finished_settings(setting.options);
    } catch (const Error& refusal) {
      result.left_out.push_back(setting.label);
      if (!first_refusal) first_refusal = refusal;
      continue;
    }
    setting.number = static_cast<int>(result.settings.size()) + 1;
    result.settings.push_back(std::move(setting));
  } while (advance(indices, axes));
  if (result.settings.empty()) throw *first_refusal;
  return result;
}

}  // namespace hybridrt::cli
