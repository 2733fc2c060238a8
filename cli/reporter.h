#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "cli/progress.h"
#include "cli/render_options.h"
#include "cli/render_output.h"
#include "cli/run_report.h"
#include "core/base/error.h"

namespace hybridrt::cli {

/// What the user sees while frames are rendered: text on standard error, or one JSON object per line on standard
/// output.
class Reporter {
 public:
  Reporter(const OutputOptions& options, int64_t frames);

  void warnings(const Warnings& all);
  /// What users may want to know, unless they want quiet.
  void notes(const std::vector<std::string>& all);
  void start(const RenderOptions& options, const RenderJob& job, const RunFacts& facts);
  /// A frame whose files were there.
  void kept(int frame, const std::filesystem::path& path);
  void frame(const Frame& frame, const std::filesystem::path& path);
  void end(const RunTotals& totals, bool stopped);

 private:
  /// One more frame is there: what progress, SIGUSR1 and events say.
  void count();

  const bool json_, quiet_, verbose_;
  const int64_t frames_;
  int64_t done_ = 0;
  Progress progress_;
};

/// The last event of a run that fails.
void report_failure(const Error& problem);

}  // namespace hybridrt::cli
