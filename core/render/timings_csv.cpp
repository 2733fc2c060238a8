#include "core/render/timings_csv.h"

#include <fmt/format.h>

#include "core/render/frame_columns.h"

namespace hybridrt {
namespace {

constexpr int kCheckpointSpacing = 50;  // times what the last one took

std::string line_of(int frame, double write_ms, FrameTimings timings, const TraceStats& stats) {
  timings[PassId::write] = write_ms;
  return fmt::format("{},{}\n", frame, fmt::join(frame_cells(timings, stats), ","));
}

}  // namespace

TimingsCsv::TimingsCsv(const std::string& path)
    : file_(path == "-" ? OutputFile::standard_output() : OutputFile(path)) {
  file_.write(fmt::format("frame,{}\n", fmt::join(frame_columns(), ",")));
}

void TimingsCsv::add(const Frame& frame, int files) {
  {
    std::lock_guard lock(mutex_);
    rows_[delivered_] = {frame.number, Row{files, 0, frame.timings, frame.stats}};
    order_of_frame_[frame.number] = delivered_++;
  }
  if (files == 0) write_complete_rows();
}

void TimingsCsv::file_written(int frame, double write_ms) {
  {
    std::lock_guard lock(mutex_);
    Row& row = rows_.at(order_of_frame_.at(frame)).second;
    --row.files_left;
    row.write_ms += write_ms;
    written_ms_ += write_ms;
  }
  write_complete_rows();
}

void TimingsCsv::write_complete_rows() {
  using Clock = std::chrono::steady_clock;
  std::lock_guard lock(file_mutex_);
  const std::string rows = take_complete_rows();
  if (rows.empty()) return;
  file_.write(rows);
  const Clock::time_point start = Clock::now();
  if (start < next_checkpoint_) return;
  file_.checkpoint();
  // Copying takes longer as the file grows, so it is done less often: a million rows are not copied a million times.
  const Clock::time_point end = Clock::now();
  next_checkpoint_ = end + kCheckpointSpacing * (end - start);
}

std::string TimingsCsv::take_complete_rows() {
  std::lock_guard lock(mutex_);
  std::string lines;
  while (!rows_.empty() && rows_.begin()->second.second.files_left == 0) {
    const auto& [frame, row] = rows_.begin()->second;
    lines += line_of(frame, row.write_ms, row.timings, row.stats);
    order_of_frame_.erase(frame);
    rows_.erase(rows_.begin());
  }
  return lines;
}

void TimingsCsv::finish() {
  write_complete_rows();
  std::lock_guard lock(file_mutex_);
  file_.commit();
}

}  // namespace hybridrt
