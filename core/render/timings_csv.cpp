#include "core/render/timings_csv.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace hybridrt {

TimingsCsv::TimingsCsv(const std::string& path) : path_(path) {
  namespace fs = std::filesystem;
  if (path_ == "-") {
    file_ = stdout;
  } else {
    std::error_code problem;  // opening the file says it better
    const fs::path final_path(path_);
    if (final_path.has_parent_path()) fs::create_directories(final_path.parent_path(), problem);
    const bool replaceable = !fs::exists(final_path, problem) || fs::is_regular_file(final_path, problem);
    if (replaceable)
      temporary_ = (final_path.parent_path() / fmt::format(".{}.tmp-{}", final_path.filename().string(), getpid())).string();
    file_ = std::fopen(replaceable ? temporary_.c_str() : path_.c_str(), "wb");
    if (!file_) fail();
  }
  std::string header = "frame";
  for (std::string_view pass : kPassNames) header += fmt::format(",{}_ms", pass);
  header += ",wall_ms,pixels_hit,pixels_marked,pixels_reflective,pixels_refractive,shadow_rays,reflection_rays,"
            "refraction_rays,shadow_cpu_ms,secondary_cpu_ms,primary_shadow_rays\n";
  std::fputs(header.c_str(), file_);
}

TimingsCsv::~TimingsCsv() {
  if (!file_ || file_ == stdout) return;
  std::fclose(file_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void TimingsCsv::fail() const {
  throw error(ErrorKind::output, "{}: cannot write the timings: {}", path_, std::strerror(errno));
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
  std::fputs(line.c_str(), file_);
}

void TimingsCsv::finish() {
  std::lock_guard lock(mutex_);
  write_complete_rows();
  if (std::fflush(file_) != 0 || std::ferror(file_)) fail();
  if (file_ == stdout) return;
  if (temporary_.empty()) {
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail();
    return;
  }
  if (fsync(fileno(file_)) != 0) fail();
  if (std::fclose(std::exchange(file_, nullptr)) != 0 || std::rename(temporary_.c_str(), path_.c_str()) != 0) {
    const int reason = errno;
    unlink(temporary_.c_str());
    errno = reason;
    fail();
  }
}

}  // namespace hybridrt
