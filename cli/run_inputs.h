#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/render_options.h"
#include "cli/render_output.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// What run.json needs to tell how to make the run's pictures again: the command line, camera and lights in world space
/// with y up, background, the files written, the day, and fingerprints of the scene and of each of `frames`.
nlohmann::ordered_json run_inputs(const std::vector<std::string>& command_line, const RenderOptions& options,
                                  const RenderJob& job, const OutputPaths& paths, const std::vector<int>& frames);

}  // namespace hybridrt::cli
