#include "core/render/timings_csv.h"

#include <fmt/format.h>

namespace hybridrt {
namespace {

constexpr PassId kThreadTimed[] = {PassId::id, PassId::mark, PassId::trace, PassId::shade};

constexpr int kCheckpointSpacing = 50;  // times what the last one took

std::string line_of(int frame, double write_ms, FrameTimings timings, const TraceStats& s) {
  timings[PassId::write] = write_ms;
  std::string line = fmt::format("{}", frame);
  for (double ms : timings.pass_ms) line += fmt::format(",{:.3f}", ms);
  line += fmt::format(",{:.3f},{},{},{},{},{},{},{},{:.3f},{:.3f},{},{:.3f},{},{}", timings.wall_ms, s.pixels_hit,
                      s.pixels_marked, s.pixels_reflective, s.pixels_refractive, s.shadow_rays, s.reflection_rays,
                      s.refraction_rays, s.shadow_cpu_ms, s.secondary_cpu_ms, s.primary_shadow_rays, s.repair_ms,
                      s.pixels_suspect, s.pixels_repaired);
  for (PassId pass : kThreadTimed) line += fmt::format(",{:.3f}", timings.threads_ms[static_cast<size_t>(pass)]);
  line += '\n';
  return line;
}

}  // namespace

TimingsCsv::TimingsCsv(const std::string& path)
    : file_(path == "-" ? OutputFile::standard_output() : OutputFile(path)) {
  std::string header = "frame";
  for (std::string_view pass : kPassNames) header += fmt::format(",{}_ms", pass);
  header +=
      ",wall_ms,pixels_hit,pixels_marked,pixels_reflective,pixels_refractive,shadow_rays,reflection_rays,"
      "refraction_rays,shadow_cpu_ms,secondary_cpu_ms,primary_shadow_rays,repair_ms,pixels_suspect,pixels_repaired";
  for (PassId pass : kThreadTimed) header += fmt::format(",{}_cpu_ms", kPassNames[static_cast<size_t>(pass)]);
  header += '\n';
  file_.write(header);
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
