#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/render/render_job.h"

namespace hybridrt::cli {

/// What a run has to tell at its end.
struct RunTotals {
  int64_t frames = 0;
  int64_t kept = 0;      ///< beside them, those whose files were there
  int64_t repeated = 0;  ///< of `frames`, those that were not rendered again
  TraceStats stats;      ///< of those that were rendered, as is what follows
  double wall_ms = 0;

  /// Milliseconds of each frame's passes (PassId), and its wall time as the last.
  std::vector<std::array<float, static_cast<size_t>(PassId::count) + 1>> times_ms;

  double load_ms = 0;       ///< reading the scene
  double rendering_ms = 0;  ///< from when the scene is ready to the last frame's download
  double waited_ms = 0;     ///< of that, until the writers took a picture: they were behind
  double drain_ms = 0;      ///< writing that was left after that
  double write_ms = 0;      ///< encoding and writing all files, on other threads

  void add(const Frame& frame);
  double frames_per_second() const;
  /// As if nothing had to be written, and from when the scene is ready until all files are there.
  double rendered_per_second() const;
  double written_per_second() const;
};

/// The closing table: the first frame's time per pass apart from the median of the others, which no longer build what
/// is kept; rays fired and saved; frames per second, rendered and written.
std::string summary_table(const RenderJob& job, const RunTotals& totals);

}  // namespace hybridrt::cli
