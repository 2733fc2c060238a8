#pragma once

#include "core/base/output_file.h"
#include "core/render/frame.h"

#include <map>
#include <mutex>
#include <string>

namespace hybridrt {

/// The timings CSV: one row a frame, in the order of delivery, each held back until the frame's files are
/// written and its write_ms is known. The file appears in finish(), whole. Thread-safe.
class TimingsCsv {
 public:
  /// "-" is standard output. Throws Error(output) when the file cannot be made.
  explicit TimingsCsv(const std::string& path);

  /// `files`: how many file_written() calls will follow for this frame.
  void add(const Frame& frame, int files);
  void file_written(int frame, double write_ms);

  /// Sum of all write_ms so far.
  double written_ms() const { return written_ms_; }

  /// Makes the file appear. Throws Error(output).
  void finish();

 private:
  struct Row {
    int files_left = 0;
    double write_ms = 0;
    FrameTimings timings;
    TraceStats stats;
  };
  void write_complete_rows();
  void write_row(int frame, const Row& row);

  std::mutex mutex_;
  OutputFile file_;
  std::map<int64_t, std::pair<int, Row>> rows_;  ///< by order of delivery: frame and row
  std::map<int, int64_t> order_of_frame_;
  int64_t delivered_ = 0;
  double written_ms_ = 0;
};

}  // namespace hybridrt
