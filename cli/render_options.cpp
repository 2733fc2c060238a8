#include "cli/render_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/render_option_table.h"
#include "core/base/error.h"
#include "core/base/given_descriptor.h"
#include "core/load/scene_file.h"
#include "core/load/spooled_scene.h"

namespace hybridrt::cli {
namespace {

/// `name` as in a scene JSON, without dashes.
void apply_setting(const std::vector<RenderOption>& table, const std::string& name, const std::string& value,
                   RenderOptions& options) {
  const auto option =
      std::find_if(table.begin(), table.end(), [&](const RenderOption& o) { return o.name + 2 == name; });
  if (option == table.end()) throw error(ErrorKind::usage, "there is no render option '{}'", name);
  option->set(options, value);
}

void require_inside(const PixelRect& crop, const RenderSettings& s) {
  if (crop.x_px < 0 || crop.y_px < 0 || crop.width_px < 1 || crop.height_px < 1 ||
      crop.x_px > s.width_px - crop.width_px || crop.y_px > s.height_px - crop.height_px)
    throw error(ErrorKind::usage, "--crop {},{},{},{}: it must lie inside the frame of {}x{} pixels", crop.x_px,
                crop.y_px, crop.width_px, crop.height_px, s.width_px, s.height_px);
}

}  // namespace

void add_render_options(CLI::App& app, RenderOptions& o) {
  app.add_option("scene", o.scene,
                 "OBJ, PLY, OFF, STL or OM file, - for standard input, scene .json, or scene:NAME[,KEY=VALUE] (" +
                     procedural_names() + ")")
      ->required()
      ->type_name("SCENE");
  for (const RenderOption& option : render_option_table()) {
    const auto take = [&o, name = std::string(option.name), set = option.set](const std::string& value) {
      set(o, value);
      o.given.emplace_back(name, value);
    };
    if (option.is_flag())
      app.add_flag_callback(
             option.name, [take] { take("true"); }, option.help)
          ->group(option.group);
    else
      app.add_option_function<std::string>(option.name, take, option.help)
          ->type_name(option.value)
          ->group(option.group);
  }
}

SceneSource scene_source_of(const RenderOptions& options) {
  const bool is_piped = options.scene == "-" || descriptor_named_by(options.scene).has_value();
  if (is_piped && !options.input_format)
    throw error(ErrorKind::usage, "SCENE {} is {}: say what it brings, like --input-format obj", options.scene,
                options.scene == "-" ? "standard input" : "a pipe");
  if (!is_piped && options.input_format)
    throw error(ErrorKind::usage, "--input-format is for SCENE - (standard input); {} says by its name what it is",
                options.scene);
  return is_piped ? read_piped_scene(options.scene, *options.input_format) : parse_scene_source(options.scene);
}

void set_render_option(RenderOptions& options, const std::string& name, const std::string& value) {
  apply_setting(render_option_table(), name.substr(2), value, options);
  options.given.emplace_back(name, value);
}

RenderOptions with_scene_settings(const RenderOptions& options, const SceneSource& source) {
  if (source.settings.empty() && options.config.empty()) return options;
  const std::vector<RenderOption> table = render_option_table();
  RenderOptions merged;
  merged.scene = options.scene;
  merged.probes = options.probes;
  const auto merge = [&](const std::vector<std::pair<std::string, std::string>>& settings, const std::string& where) {
    try {  // without the command line, so that errors are the file's
      for (const auto& [name, value] : settings) apply_setting(table, name, value, merged);
      finished_settings(merged);
      parse_frame_spec(merged.frames);
    } catch (const Error& problem) {
      throw error(ErrorKind::input, "{}: {}", where, problem.what());
    }
  };
  merge(source.settings, source.argument + ": settings");
  if (!options.config.empty()) merge(read_settings_file(options.config), options.config);
  for (const auto& [name, value] : options.given) apply_setting(table, name.substr(2), value, merged);
  merged.given = options.given;
  return merged;
}

RenderSettings finished_settings(const RenderOptions& o) {
  RenderSettings s = o.settings;
  s.shadows = o.shadows.value_or(default_shadows(s.method));
  require_method_takes(s.method, s.shadows);
  require_adaptive_fits(s);
  if (s.crop) require_inside(*s.crop, s);
  return s;
}

}  // namespace hybridrt::cli
