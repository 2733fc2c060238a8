#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/render_options.h"

namespace hybridrt::cli {

/// One option of a render. The table of these is the only place that holds its name, values, default and help: parser,
/// help text and the `settings` of a scene JSON all follow it.
struct RenderOption {
  const char* name;   ///< "--size"
  const char* value;  ///< its value's name in the help: "WxH"; empty for a flag
  const char* group;  ///< its group in the help
  std::string help;   ///< values and default included
  /// Stores the value in the options. Throws Error(usage), naming the option and what it takes.
  std::function<void(RenderOptions&, const std::string& value)> set;

  bool is_flag() const { return *value == 0; }
};

std::vector<RenderOption> render_option_table();

}  // namespace hybridrt::cli
