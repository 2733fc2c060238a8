#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/render_options.h"

namespace hybridrt::cli {

/// What changes with an option's values, from little to much.
enum class Affects {
  run,      ///< which frames are rendered, and what is written of them
  quality,  ///< how well and how fast frames are made: what they should look like stays
  view,     ///< what is seen of the scene
  scene,    ///< the scene itself: it is loaded for each value
};

/// One option of a render. The table of these is the only place that holds its name, values, default and help: parser,
/// help text, the `settings` of a scene JSON and the axes of sweeps all follow it.
struct RenderOption {
  const char* name;   ///< "--size"
  const char* value;  ///< its value's name in the help: "WxH"; empty for a flag
  const char* group;  ///< its group in the help
  std::string help;   ///< values and default included
  /// Stores the value in the options. Throws Error(usage), naming the option and what it takes.
  std::function<void(RenderOptions&, const std::string& value)> set;
  Affects affects = Affects::view;

  bool is_flag() const { return *value == 0; }
};

std::vector<RenderOption> render_option_table();

}  // namespace hybridrt::cli
