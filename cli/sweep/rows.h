#pragma once

#include <map>

#include "cli/sweep/accuracy.h"
#include "cli/sweep/csv.h"
#include "cli/sweep/visit.h"
#include "core/base/output_file.h"

namespace hybridrt::cli {

/// The cells of a frame's accuracy, in the order of the columns; empty ones where it is not known.
using AccuracyCells = std::vector<std::string>;
AccuracyCells accuracy_cells(const std::optional<Accuracy>& accuracy);

/// What all rows of a setting have in common.
struct RowContext {
  const SweepSetting& setting;
  const std::vector<Axis>& axes;
  const RenderJob& job;
  double load_ms;
  int threads;
  uint64_t peak_bytes;  ///< of memory; 0: not measured
};

/// sweep.csv: one row per setting, round and frame. The file is whole at any moment: it is replaced after each visit.
class SweepRows {
 public:
  /// Takes over the complete visits of an earlier run's file, if there is one. Throws Error(input) if that is no table
  /// of this sweep.
  SweepRows(const std::filesystem::path& file, const std::vector<Axis>& axes, size_t frames_per_visit);

  bool has(int setting, int round) const { return visits_.contains({setting, round}); }

  /// What an earlier round found for the frames of a setting, in order; empty if none did.
  std::vector<AccuracyCells> accuracy_of(int setting) const;

  void add(const RowContext& context, int round, const Visit& visit, const std::vector<AccuracyCells>& accuracy);
  /// A setting that failed: one row with the reason.
  void add_failure(const SweepSetting& setting, const std::vector<Axis>& axes, int round, const std::string& reason);

  size_t failures() const { return failures_; }
  /// Completes the file. Throws Error(output).
  void finish() { file_.commit(); }

 private:
  using Row = std::vector<std::string>;
  void append(std::pair<int, int> visit, const std::vector<Row>& rows);

  std::vector<std::string> header_;
  std::map<std::pair<int, int>, std::vector<Row>> visits_;  ///< by setting and round
  size_t failures_ = 0;
  OutputFile file_;
};

}  // namespace hybridrt::cli
