#include "core/render/timings_csv.h"

#include <fmt/format.h>

namespace hybridrt {

TimingsCsv::TimingsCsv(const std::string& path) : file_(path == "-" ? "/dev/stdout" : path) {
  std::string header = "frame";
  for (std::string_view pass : kPassNames) header += fmt::format(",{}_ms", pass);
  header += ",wall_ms,pixels_hit,pixels_marked,pixels_reflective,pixels_refractive,shadow_rays,reflection_rays,"
            "refraction_rays,shadow_cpu_ms,secondary_cpu_ms,primary_shadow_rays\n";
  file_.write(header);
}

void TimingsCsv::add(const Frame& frame, int files) {
  std::lock_guard lock(mutex_);
  rows_[delivered_] = {frame.number, Row{files, 0, frame.timings, frame.stats}};
  order_of_frame_[frame.number] = delivered_++;
  write_complete_rows();
}

void TimingsCsv::file_written(int frame, double write_ms) {
  std::lock_guard lock(mutex_);
  Row& row = rows_.at(order_of_frame_.at(frame)).second;
  --row.files_left;
  row.write_ms += write_ms;
  written_ms_ += write_ms;
  write_complete_rows();
}

void TimingsCsv::write_complete_rows() {
  while (!rows_.empty() && rows_.begin()->second.second.files_left == 0) {
    const auto& [frame, row] = rows_.begin()->second;
    write_row(frame, row);
    order_of_frame_.erase(frame);
    rows_.erase(rows_.begin());
  }
}

void TimingsCsv::write_row(int frame, const Row& row) {
  FrameTimings timings = row.timings;
  timings[PassId::write] = row.write_ms;
  const TraceStats& s = row.stats;
  std::string line = fmt::format("{}", frame);
  for (double ms : timings.pass_ms) line += fmt::format(",{:.3f}", ms);
  line += fmt::format(",{:.3f},{},{},{},{},{},{},{},{:.3f},{:.3f},{}\n", timings.wall_ms, s.pixels_hit,
                      s.pixels_marked, s.pixels_reflective, s.pixels_refractive, s.shadow_rays, s.reflection_rays,
                      s.refraction_rays, s.shadow_cpu_ms, s.secondary_cpu_ms, s.primary_shadow_rays);
  file_.write(line);
}

void TimingsCsv::finish() {
  std::lock_guard lock(mutex_);
  write_complete_rows();
  file_.commit();
}

}  // namespace hybridrt
