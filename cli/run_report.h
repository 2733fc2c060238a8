#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/render_options.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// Sums over the frames of a run, for its closing table and run.json.
struct RunTotals {
  int64_t frames = 0;
  FrameTimings sum;
  TraceStats stats;
  double load_ms = 0;       ///< reading the scene
  double rendering_ms = 0;  ///< from when the scene is ready to the last frame's download
  double drain_ms = 0;      ///< writing that was left after that

  void add(const Frame& frame);
  double frames_per_second() const;
};

/// The closing table: time per pass, rays fired and saved, frames per second.
std::string summary_table(const RenderJob& job, const RunTotals& totals);

/// Facts of a run for run.json: version, scene, settings, GL renderer, processor, times, memory.
nlohmann::ordered_json run_report(const RenderOptions& options, const RenderJob& job, int threads,
                                  const RunFacts& facts, const RunTotals& totals, const Warnings& warnings);

/// The settings that decide pixels, as one line for image metadata.
std::string settings_line(const RenderSettings& settings);

/// The processor's name, from the system.
std::string processor_name();

}  // namespace hybridrt::cli
