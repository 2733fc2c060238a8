#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/parse_message.h"
#include "cli/render_options.h"
#include "core/base/error.h"
#include "core/load/scene_file.h"

namespace hybridrt::cli {

RenderOptions with_scene_settings(const RenderOptions& options) {
  if (!is_scene_file(options.scene) || options.scene.starts_with("scene:")) return options;
  const SceneDescription scene = read_scene_file(options.scene);
  if (scene.settings.empty()) return options;

  // Parsed twice: alone, so that what is wrong is the file's fault, and below what the command line gave.
  const auto parsed = [](const std::vector<std::pair<std::string, std::string>>& settings, RenderOptions& into) {
    CLI::App parser;
    add_render_options(parser, into);
    std::vector<std::string> arguments;  // CLI11 takes them backwards
    for (const auto& [name, value] : settings) {
      const CLI::Option* option = parser.get_option_no_throw(name);
      if (!option || name == "--help") throw error(ErrorKind::usage, "there is no render option '{}'", name.substr(2));
      if (option->get_items_expected_max() == 0 && value == "false") continue;
      arguments.push_back(option->get_items_expected_max() == 0 ? name : name + "=" + value);
    }
    arguments.push_back(into.scene);
    std::reverse(arguments.begin(), arguments.end());
    try {
      parser.parse(arguments);
    } catch (const CLI::ParseError& problem) {
      throw Error(ErrorKind::usage, parse_message(parser, problem));
    }
  };
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [name, value] : scene.settings) all.emplace_back("--" + name, value);
  try {
    RenderOptions alone;
    alone.scene = options.scene;
    parsed(all, alone);
    make_settings(alone);
    parse_frame_spec(alone.frames);
  } catch (const Error& problem) {
    throw error(ErrorKind::input, "{}: settings: {}", options.scene, problem.what());
  }
  std::erase_if(all, [&](const auto& setting) {
    return std::any_of(options.given.begin(), options.given.end(),
                       [&](const auto& given) { return given.first == setting.first; });
  });
  all.insert(all.end(), options.given.begin(), options.given.end());
  RenderOptions merged;
  merged.scene = options.scene;
  parsed(all, merged);
  merged.given = options.given;
  return merged;
}

}  // namespace hybridrt::cli
