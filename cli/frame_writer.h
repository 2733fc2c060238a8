#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/frame_metadata.h"
#include "cli/render_output.h"
#include "cli/run_report.h"
#include "core/image/contact_sheet.h"
#include "core/render/file_sink.h"
#include "core/render/timings_csv.h"

namespace hybridrt::cli {

/// Small copies of evenly spaced frames for the contact sheet.
class SheetCollector {
 public:
  explicit SheetCollector(const FrameSpec& frames);
  bool shows(int frame) const { return shown_.contains(frame); }
  void add(const Frame& frame);
  Image sheet() const;

  /// What the cells and the sheet take at most.
  static uint64_t most_bytes(const RenderSettings& settings, int64_t frame_count);

 private:
  std::set<int> shown_;
  std::vector<Image> cells_;
};

/// Takes finished frames and writes a run's files: pictures and AOVs, timings, contact sheet.
class FrameWriter {
 public:
  /// Job, paths and options must outlive it. Throws Error(output) when the timings cannot be written.
  FrameWriter(const OutputOptions& options, const OutputPaths& paths, const RenderJob& job, int threads);

  /// Before the first frame, once it is known where passes run.
  void start(const RunFacts& facts) {
    metadata_ = run_metadata(job_, facts, layered_);
    metadata_.halfs = options_.exr == ExrNumbers::half;
    if (timings_) timings_->start();
  }

  /// Whether the files of a frame are there and are what this run would write, byte for byte; then their row of the
  /// earlier timings.csv is kept too. A frame that such a file lacks is wanted: a run was killed before it wrote the
  /// row. Asked for each frame, in order, before it is rendered. Frames of the contact sheet are wanted.
  bool keeps(int frame);

  /// Blocks while too many pictures wait to be written. Throws Error(output) if an earlier one could not be written.
  void write(Frame&& frame);
  /// Waits until everything is written; throws as write(). Adds the time of writing to the totals.
  void finish(RunTotals& totals);

 private:
  const OutputOptions& options_;
  const OutputPaths& paths_;
  const RenderJob& job_;
  const bool layered_;      ///< AOVs are layers of the picture, not files of their own
  const bool with_record_;  ///< the format keeps no metadata
  RunMetadata metadata_;
  bool goes_on_with_rows_ = false;          ///< there is a timings file of an earlier run
  std::deque<std::pair<int, bool>> asked_;  ///< frames of keeps() that have not come to the timings; true: kept
  SheetCollector sheet_;
  std::optional<TimingsCsv> timings_;
  FileSink sink_;
  std::optional<PictureStream> stream_;  ///< takes the pictures, and the sink no more than the contact sheet

  bool is_kept(int frame);
  void add_kept_rows_before(int frame);
};

}  // namespace hybridrt::cli
