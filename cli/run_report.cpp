#include "cli/run_report.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "cli/version.h"

namespace hybridrt::cli {
namespace {

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::string rays(int64_t count) {
  if (count < 100'000) return fmt::format("{}", count);
  return fmt::format("{:.2f} M", static_cast<double>(count) * 1e-6);
}

double per_frame(double sum, const RunTotals& totals) {
  return totals.frames ? sum / static_cast<double>(totals.frames) : 0;
}

}  // namespace

void RunTotals::add(const Frame& frame) {
  ++frames;
  for (size_t i = 0; i < sum.pass_ms.size(); ++i) sum.pass_ms[i] += frame.timings.pass_ms[i];
  sum.wall_ms += frame.timings.wall_ms;
  stats.add(frame.stats);
}

double RunTotals::frames_per_second() const {
  return sum.wall_ms > 0 ? static_cast<double>(frames) / (sum.wall_ms * 1e-3) : 0;
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string settings_line(const RenderSettings& s) {
  std::string line = fmt::format("{}x{} method {} shadows {} reflection-depth {}", s.width_px, s.height_px,
                                 name_of(s.method), name_of(s.shadows), s.reflection_depth);
  if (s.alpha) line += " alpha";
  if (s.samples > 1) line += fmt::format(" samples {}", s.samples);
  if (s.crop) line += fmt::format(" crop {},{},{},{}", s.crop->x_px, s.crop->y_px, s.crop->width_px, s.crop->height_px);
  if (uses_shadow_map(s)) line += fmt::format(" shadow-map {} {}", s.shadow_map_px, name_of(s.shadow_warp));
  if (s.shadows == ShadowMode::blur) line += fmt::format(" blur-kernel {}", s.blur_kernel_px);
  return line;
}

std::string summary_table(const RenderJob& job, const RunTotals& totals) {
  static constexpr const char* kWhat[] = {"1 shadow map",
                                          "2 triangle ids + shadow test",
                                          "3 marking",
                                          "  readback",
                                          "4 rays on the CPU",
                                          "  upload",
                                          "5 shading",
                                          "  download",
                                          "  encoding + writing (in parallel)"};
  std::string out = fmt::format("\n{:<40} {:>12}\n", "pass", "ms per frame");
  for (size_t i = 0; i < totals.sum.pass_ms.size(); ++i)
    out += fmt::format("{:<40} {:>12.2f}\n", kWhat[i], per_frame(totals.sum.pass_ms[i], totals));
  out += fmt::format("{:<40} {:>12.2f}\n\n", "from frame to frame", per_frame(totals.sum.wall_ms, totals));

  const TraceStats& s = totals.stats;
  const bool rasterised = job.settings.method == Method::hybrid || job.settings.method == Method::raster;
  const PixelRect picture = picture_rect(job.settings);
  const int64_t primary = totals.frames * picture.width_px * picture.height_px;
  out += fmt::format("{:<26} {:>12} {:>12}\n", "rays", "fired", "saved");
  out +=
      fmt::format("{:<26} {:>12} {:>12}\n", "primary", rays(rasterised ? 0 : primary), rays(rasterised ? primary : 0));
  const auto casting = static_cast<int64_t>(count_shadow_casters(job.lights.lights));
  const int64_t receivers_untraced = std::max<int64_t>(0, casting * s.pixels_hit - s.primary_shadow_rays);
  out += fmt::format("{:<26} {:>12} {:>12}\n", "shadow, seen directly", rays(s.primary_shadow_rays),
                     rays(job.settings.shadows == ShadowMode::none ? 0 : receivers_untraced));
  out += fmt::format("{:<26} {:>12}\n", "shadow, in reflections", rays(s.shadow_rays - s.primary_shadow_rays));
  out += fmt::format("{:<26} {:>12}\n", "reflection", rays(s.reflection_rays));
  out += fmt::format("{:<26} {:>12}\n\n", "refraction", rays(s.refraction_rays));
  if (rasterised && !uses_gl(job.settings))
    out += fmt::format("all passes on the CPU{}\n",
                       job.forms_reason.empty() ? "" : fmt::format(" ({})", job.forms_reason));
  out += fmt::format("{} frames, {:.2f} frames/s\n", totals.frames, totals.frames_per_second());
  return out;
}

nlohmann::ordered_json run_report(const RenderOptions& options, const RenderJob& job, int threads,
                                  const RunFacts& facts, const RunTotals& totals, const Warnings& warnings) {
  using json = nlohmann::ordered_json;
  const RenderSettings& s = job.settings;
  json report = {
      {"version", kVersion}, {"commit", kCommit}, {"compiler", kCompiler}, {"libraries", library_versions()}};
  report["scene"] = {
      {"source", options.scene}, {"triangles", job.scene.triangle_count()}, {"materials", job.scene.materials.size()}};
  report["settings"] = {
      {"frames", options.frames},
      {"sequence", {job.motion.sequence.first, job.motion.sequence.last}},
      {"width", s.width_px},
      {"height", s.height_px},
      {"crop", s.crop ? json{s.crop->x_px, s.crop->y_px, s.crop->width_px, s.crop->height_px} : json(nullptr)},
      {"method", name_of(s.method)},
      {"shadows", name_of(s.shadows)},
      {"blur_kernel", s.blur_kernel_px},
      {"shadow_map", s.shadow_map_px},
      {"shadow_warp", name_of(s.shadow_warp)},
      {"reflection_depth", s.reflection_depth},
      {"samples", s.samples},
      {"frames_in_flight", s.frames_in_flight}};
  report["gl"] = facts.gl ? json{{"device", facts.gl->device},
                                 {"binding", facts.gl->binding},
                                 {"renderer", facts.gl->renderer},
                                 {"version", facts.gl->version}}
                          : json(nullptr);
  report["passes"] = uses_gl(s) ? json{{"form", "gl"}} : json{{"form", "cpu"}, {"why", job.forms_reason}};
  report["processor"] = processor_name();
  report["threads"] = threads;
  report["accel"] = facts.accel.empty() ? json(nullptr) : json(facts.accel);
  report["load_ms"] = totals.load_ms;
  report["accel_build_ms"] = facts.accel_build_ms;
  report["ready_ms"] = facts.ready_ms;
  report["rendering_ms"] = totals.rendering_ms;
  report["drain_ms"] = totals.drain_ms;
  report["frames"] = totals.frames;
  report["frames_per_second"] = totals.frames_per_second();
  report["peak_memory_mib"] = peak_memory_mib();
  report["warnings"] = warnings;
  return report;
}

}  // namespace hybridrt::cli
