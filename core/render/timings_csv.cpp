#include "core/render/timings_csv.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

#include "core/render/frame_columns.h"

namespace hybridrt {
namespace {

constexpr int kCheckpointSpacing = 50;  // times what the last one took

std::string line_of(int frame, double write_ms, FrameTimings timings, const TraceStats& stats) {
  timings[PassId::write] = write_ms;
  return fmt::format("{},{}\n", frame, fmt::join(frame_cells(timings, stats), ","));
}

std::string header() { return fmt::format("frame,{}", fmt::join(frame_columns(), ",")); }

}  // namespace

std::optional<TimingsRows> read_timings_rows(const std::string& path) {
  TimingsRows rows;
  std::error_code unreachable;
  if (!std::filesystem::is_regular_file(path, unreachable)) return std::nullopt;
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != header()) return std::nullopt;
  const auto cells = std::count(line.begin(), line.end(), ',');
  while (std::getline(file, line)) {
    int frame = 0;
    const auto read = std::from_chars(line.data(), line.data() + line.size(), frame);
    if (read.ec == std::errc() && *read.ptr == ',' && std::count(line.begin(), line.end(), ',') == cells)
      rows[frame] = line;
  }
  return rows;
}

TimingsCsv::TimingsCsv(const std::string& path, TimingsRows earlier)
    : path_(path), file_(path == "-" ? OutputFile::standard_output() : OutputFile(path)), earlier_(std::move(earlier)) {
  file_.write(header() + "\n");
}

void TimingsCsv::start() {
  std::error_code unreachable;
  std::lock_guard lock(file_mutex_);
  if (path_ != "-" && !std::filesystem::exists(path_, unreachable)) publish();
}

void TimingsCsv::add(const Frame& frame, int files) {
  {
    std::lock_guard lock(mutex_);
    rows_[delivered_] = {frame.number, Row{files, 0, frame.timings, frame.stats, {}}};
    order_of_frame_[frame.number] = delivered_++;
    earlier_.erase(frame.number);
  }
  if (files == 0) write_complete_rows();
}

bool TimingsCsv::has_earlier(int frame) {
  std::lock_guard lock(mutex_);
  return earlier_.contains(frame);
}

void TimingsCsv::add_earlier(int frame) {
  std::lock_guard lock(mutex_);
  auto found = earlier_.extract(frame);
  if (found.empty()) return;
  Row row;
  row.line = std::move(found.mapped());
  rows_[delivered_++] = {frame, std::move(row)};
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
  publish();
  // Copying takes longer as the file grows, so it is done less often: a million rows are not copied a million times.
  const Clock::time_point end = Clock::now();
  next_checkpoint_ = end + kCheckpointSpacing * (end - start);
}

/// With what the earlier file has beyond this one.
void TimingsCsv::publish() {
  std::string more;
  {
    std::lock_guard lock(mutex_);
    for (const auto& [order, entry] : rows_)
      if (const Row& row = entry.second; !row.line.empty()) more += row.line + "\n";
    for (const auto& [frame, line] : earlier_) more += line + "\n";
  }
  file_.checkpoint(more);
}

std::string TimingsCsv::take_complete_rows() {
  std::lock_guard lock(mutex_);
  std::string lines;
  while (!rows_.empty() && rows_.begin()->second.second.files_left == 0) {
    const auto& [frame, row] = rows_.begin()->second;
    if (row.line.empty()) {
      lines += line_of(frame, row.write_ms, row.timings, row.stats);
      order_of_frame_.erase(frame);
    } else {
      lines += row.line + "\n";
    }
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
