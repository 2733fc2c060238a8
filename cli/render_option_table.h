#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/render_options.h"

namespace hybridrt::cli {

/// One option of a render. The table of these is the only place that knows its name, its values, its default and its
/// help: the parser, the help text and the `settings` of a scene JSON all go by it.
struct RenderOption {
  const char* name;   ///< "--size"
  const char* value;  ///< what stands for its value in the help: "WxH"; empty for a flag
  const char* group;  ///< of the help
  std::string help;   ///< values and default included
  /// Puts the value's meaning into the options. Throws Error(usage) naming the option and what it takes.
  std::function<void(RenderOptions&, const std::string& value)> set;

  bool is_flag() const { return *value == 0; }
};

std::vector<RenderOption> render_option_table();

}  // namespace hybridrt::cli
