#include "cli/summary.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/render/samples.h"

namespace hybridrt::cli {
namespace {

constexpr size_t kWall = static_cast<size_t>(PassId::count);  // its place in RunTotals::times_ms

std::string rays(int64_t count) {
  if (count < 100'000) return fmt::format("{}", count);
  return fmt::format("{:.2f} M", static_cast<double>(count) * 1e-6);
}

double per_second(int64_t frames, double ms) { return ms > 0 ? static_cast<double>(frames) / (ms * 1e-3) : 0; }

std::string name_of_row(size_t pass, const RenderJob& job) {
  static constexpr const char* kNames[] = {"1 light buffer",    "2 triangle ids", "3 marking", "  readback",
                                           "4 rays on the CPU", "  upload",       "5 shading", "  download"};
  static constexpr const char* kOfRays[] = {
      "light buffer", "primary rays", "points seen", "", "shadow rays, reflections", "", "shading", "unpacking"};
  if (pass == kWall) return "from frame to frame";
  if (job.settings.method == Method::raytrace) return kOfRays[pass];
  if (!uses_shadow_map(job.settings)) return kNames[pass];
  if (pass == static_cast<size_t>(PassId::shadow_map)) return "1 shadow map";
  if (pass == static_cast<size_t>(PassId::id)) return "2 triangle ids + shadow test";
  return kNames[pass];
}

/// Of the frames after the first.
double median_ms(const RunTotals& totals, size_t column) {
  std::vector<float> values;
  for (size_t i = 1; i < totals.times_ms.size(); ++i) values.push_back(totals.times_ms[i][column]);
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::string times_table(const RenderJob& job, const RunTotals& totals) {
  if (totals.times_ms.empty()) return "";
  const bool several = totals.times_ms.size() > 1;
  std::string out = fmt::format("\n{:<32} {:>14}", "pass, ms", several ? "first frame" : "frame");
  out += several ? fmt::format(" {:>14}\n", "then, median") : "\n";
  for (size_t column = 0; column <= kWall; ++column) {
    const bool ran =
        std::any_of(totals.times_ms.begin(), totals.times_ms.end(), [&](const auto& row) { return row[column] > 0; });
    if (column == static_cast<size_t>(PassId::write) || !ran) continue;
    out += fmt::format("{:<32} {:>14.2f}", name_of_row(column, job), totals.times_ms.front()[column]);
    out += several ? fmt::format(" {:>14.2f}\n", median_ms(totals, column)) : "\n";
  }
  out += fmt::format("{:<32} {:>14.2f}\n\n", "encoding + writing, in parallel",
                     totals.write_ms / static_cast<double>(totals.frames));
  return out;
}

std::string rays_table(const RenderJob& job, const RunTotals& totals) {
  const TraceStats& s = totals.stats;
  const bool rasterised = job.settings.method == Method::hybrid || job.settings.method == Method::raster;
  const PixelRect picture = picture_rect(job.settings);
  const int64_t pixels = (totals.frames - totals.repeated) * picture.width_px * picture.height_px;
  const int64_t primary = samples_taken(job.settings, pixels, s.pixels_resampled);
  const auto casting = static_cast<int64_t>(count_shadow_casters(job.lights.lights));
  const int64_t receivers_untraced = std::max<int64_t>(0, casting * s.pixels_hit - s.primary_shadow_rays);
  std::string out = fmt::format("{:<26} {:>12} {:>12}\n", "rays", "fired", "saved");
  out +=
      fmt::format("{:<26} {:>12} {:>12}\n", "primary", rays(rasterised ? 0 : primary), rays(rasterised ? primary : 0));
  out += fmt::format("{:<26} {:>12} {:>12}\n", "shadow, seen directly", rays(s.primary_shadow_rays),
                     rays(job.settings.shadows == ShadowMode::none ? 0 : receivers_untraced));
  out += fmt::format("{:<26} {:>12}\n", "shadow, in reflections", rays(s.shadow_rays - s.primary_shadow_rays));
  out += fmt::format("{:<26} {:>12}\n", "reflection", rays(s.reflection_rays));
  out += fmt::format("{:<26} {:>12}\n\n", "refraction", rays(s.refraction_rays));
  if (rasterised && !uses_gl(job.settings))
    out += fmt::format("all passes on the CPU{}\n",
                       job.forms_reason.empty() ? "" : fmt::format(" ({})", job.forms_reason));
  return out;
}

}  // namespace

void RunTotals::add(const Frame& frame) {
  ++frames;
  repeated += frame.repeated;
  wall_ms += frame.timings.wall_ms;
  if (frame.repeated) return;
  stats.add(frame.stats);
  auto& row = times_ms.emplace_back();
  std::copy(frame.timings.pass_ms.begin(), frame.timings.pass_ms.end(), row.begin());
  row[kWall] = static_cast<float>(frame.timings.wall_ms);
}

double RunTotals::frames_per_second() const { return per_second(frames, wall_ms); }
double RunTotals::rendered_per_second() const { return per_second(frames, rendering_ms - waited_ms); }
double RunTotals::written_per_second() const { return per_second(frames, rendering_ms + drain_ms); }

std::string summary_table(const RenderJob& job, const RunTotals& totals) {
  std::string out = times_table(job, totals) + rays_table(job, totals);
  out += fmt::format("{} frame{}{}{}\n", totals.frames, totals.frames == 1 ? "" : "s",
                     totals.kept ? fmt::format(", {} kept", totals.kept) : "",
                     totals.repeated ? fmt::format(" ({} show what the one before shows)", totals.repeated) : "");
  out += fmt::format("rendered {:>10.2f} frames/s\n", totals.rendered_per_second());
  out += fmt::format("written  {:>10.2f} frames/s; rendering waited {:.2f} s for it, {:.2f} s were left at the end\n",
                     totals.written_per_second(), totals.waited_ms * 1e-3, totals.drain_ms * 1e-3);
  return out;
}

}  // namespace hybridrt::cli
