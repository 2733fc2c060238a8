#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/render_output.h"
#include "cli/run_report.h"
#include "core/image/contact_sheet.h"
#include "core/render/file_sink.h"
#include "core/render/timings_csv.h"

namespace hybridrt::cli {

/// Small copies of evenly spaced frames for the contact sheet.
class SheetCollector {
 public:
  explicit SheetCollector(int64_t frames);
  void add(const Image& picture);
  Image sheet() const;

 private:
  const int64_t step_;
  int64_t seen_ = 0;
  std::vector<Image> cells_;
};

/// Takes finished frames and writes a run's files: pictures and AOVs, timings, contact sheet.
class FrameWriter {
 public:
  /// Job, paths and options must outlive it. Throws Error(output) when the timings cannot be written.
  FrameWriter(const OutputOptions& options, const OutputPaths& paths, const RenderJob& job, int threads);

  /// Blocks while too many pictures wait to be written. Throws Error(output) if an earlier one could not be written.
  void write(Frame&& frame);
  /// Waits until everything is written; throws as write(). Adds the time of writing to the totals.
  void finish(RunTotals& totals);

 private:
  const OutputOptions& options_;
  const OutputPaths& paths_;
  const RenderJob& job_;
  const uint64_t scene_fingerprint_;
  const bool layered_;  ///< AOVs are layers of the picture, not files of their own
  SheetCollector sheet_;
  std::optional<TimingsCsv> timings_;
  FileSink sink_;

  void write_to_stream(const Image& picture, const ImageMetadata& metadata);
};

}  // namespace hybridrt::cli
