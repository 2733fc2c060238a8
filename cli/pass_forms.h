#pragma once

#include <optional>
#include <string>

#include "cli/render_options.h"
#include "core/base/warnings.h"

namespace hybridrt::cli {

/// Which form the passes take, on which GL, and why.
struct ChosenForms {
  PassForms forms = PassForms::gl;
  gl::ContextRequest gl;
  std::string reason;                ///< a line for people; empty: nobody need be told
  std::optional<Warning> warning{};  ///< what is wrong with a GPU that is there; once per run
};

/// --device and --require-hardware imply a GL. Devices are tried in a child process (device_probe.h), unless
/// options.probes is empty. By default a GPU whose driver fails that is left alone; a GL that was asked for is used or
/// refused. Throws Error(usage) where options contradict each other, Error(device) for a GL that cannot be used.
ChosenForms choose_forms(const RenderOptions& options, const RenderSettings& settings);

}  // namespace hybridrt::cli
