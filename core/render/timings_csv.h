#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/output_file.h"
#include "core/render/frame.h"

namespace hybridrt {

/// Rows of a timings CSV by frame, without their line ends.
using TimingsRows = std::map<int, std::string>;

/// Those of an earlier file with the same columns; nothing if there is no such file.
std::optional<TimingsRows> read_timings_rows(const std::string& path);

/// The timings CSV: one row per frame, in the order of delivery, each held back until the frame's files are written and
/// its write_ms is known. The file is written atomically, as a run may be killed: it appears with the first row and is
/// replaced by a longer one from time to time, which takes at most 2 % of the time (a killed run may lack the rows
/// since the last replacement); finish() completes it. Rows of an earlier file stay in it until their frames come, so
/// that a run that goes on with another's frames loses none when it is killed. Thread-safe; add() does not wait for the
/// disk.
class TimingsCsv {
 public:
  /// "-" is standard output. Throws Error(output) when the file cannot be created.
  explicit TimingsCsv(const std::string& path, TimingsRows earlier = {});

  /// Makes the file appear, without rows of this run, unless there is one.
  void start();

  /// `files`: how many file_written() calls will follow for this frame.
  void add(const Frame& frame, int files);
  void file_written(int frame, double write_ms);
  /// Whether the earlier file has a row of a frame that did not come yet.
  bool has_earlier(int frame);
  /// Adds a frame's row as it stands in the earlier file, if it does.
  void add_earlier(int frame);

  /// Sum of all write_ms so far.
  double written_ms() const { return written_ms_; }

  /// Completes the file; earlier rows whose frames did not come are left out. Throws Error(output).
  void finish();

 private:
  struct Row {
    int files_left = 0;
    double write_ms = 0;
    FrameTimings timings;
    TraceStats stats;
    std::string line;  ///< the whole row, if it is known already
  };
  void write_complete_rows();
  std::string take_complete_rows();
  void publish();

  std::mutex file_mutex_;  ///< locked before mutex_ where both are
  const std::string path_;
  OutputFile file_;
  std::chrono::steady_clock::time_point next_checkpoint_{};

  std::mutex mutex_;                             ///< guards what follows
  std::map<int64_t, std::pair<int, Row>> rows_;  ///< by order of delivery: frame number and row
  std::map<int, int64_t> order_of_frame_;
  TimingsRows earlier_;
  int64_t delivered_ = 0;
  double written_ms_ = 0;
};

}  // namespace hybridrt
