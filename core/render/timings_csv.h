#pragma once

#include "core/render/frame.h"

#include <cstdio>
#include <map>
#include <mutex>
#include <string>

namespace hybridrt {

/// The timings CSV: one row a frame, in the order of delivery, each held back until the frame's files are
/// written and its write_ms is known. Grows under a temporary name and gets its final one in finish(), so
/// that a file under that name is whole. A device or pipe has no whole to protect and is written straight.
/// Thread-safe.
class TimingsCsv {
 public:
  /// "-" is standard output. Makes missing folders. Throws Error(output) when the file cannot be made.
  explicit TimingsCsv(const std::string& path);
  ~TimingsCsv();  ///< without finish(): removes the temporary file
  TimingsCsv(const TimingsCsv&) = delete;
  TimingsCsv& operator=(const TimingsCsv&) = delete;

  /// `files`: how many file_written() calls will follow for this frame.
  void add(const Frame& frame, int files);
  void file_written(int frame, double write_ms);

  /// Sum of all write_ms so far.
  double written_ms() const { return written_ms_; }

  /// Writes what is complete and renames the file. Throws Error(output).
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
  [[noreturn]] void fail() const;

  std::mutex mutex_;
  std::string path_, temporary_;  ///< no temporary: written straight
  std::FILE* file_ = nullptr;
  std::map<int64_t, std::pair<int, Row>> rows_;  ///< by order of delivery: frame and row
  std::map<int, int64_t> order_of_frame_;
  int64_t delivered_ = 0;
  double written_ms_ = 0;
};

}  // namespace hybridrt
