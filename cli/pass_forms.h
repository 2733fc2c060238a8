#pragma once

#include <string>

#include "cli/render_options.h"

namespace hybridrt::cli {

/// Which form the passes take, on which GL, and why.
struct ChosenForms {
  PassForms forms = PassForms::gl;
  gl::ContextRequest gl;
  std::string reason;  ///< a line for people; empty: nobody need be told
};

/// --device and --require-hardware imply a GL. Throws Error(usage) where options contradict each other.
ChosenForms choose_forms(const RenderOptions& options, const RenderSettings& settings);

}  // namespace hybridrt::cli
