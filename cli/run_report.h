#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/render_options.h"
#include "cli/summary.h"

namespace hybridrt::cli {

/// Facts of a run for run.json: version, scene, settings, GL renderer, processor, times, memory.
nlohmann::ordered_json run_report(const RenderOptions& options, const RenderJob& job, int threads,
                                  const RunFacts& facts, const RunTotals& totals, const Warnings& warnings);

/// The settings that decide pixels, as one line for image metadata.
std::string settings_line(const RenderSettings& settings);

/// The processor's name, from the system.
std::string processor_name();

}  // namespace hybridrt::cli
