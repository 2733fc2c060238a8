#include "cli/run_report.h"

#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "cli/version.h"
#include "cli/warning_output.h"
#include "core/render/picture_files.h"

namespace hybridrt::cli {
namespace {

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace

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
  if (s.samples > 1) line += fmt::format(" samples {}{}", s.samples, s.adaptive ? " adaptive" : "");
  if (s.crop) line += fmt::format(" crop {},{},{},{}", s.crop->x_px, s.crop->y_px, s.crop->width_px, s.crop->height_px);
  if (uses_shadow_map(s)) line += fmt::format(" shadow-map {} {}", s.shadow_map_px, name_of(s.shadow_warp));
  if (s.shadows == ShadowMode::blur) line += fmt::format(" blur-kernel {}", s.blur_kernel_px);
  return line;
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
      {"adaptive", s.adaptive},
      {"aovs", aov_names(s.aovs)},
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
  report["waited_ms"] = totals.waited_ms;
  report["drain_ms"] = totals.drain_ms;
  report["write_ms"] = totals.write_ms;
  report["frames"] = totals.frames;
  report["repeated_frames"] = totals.repeated;
  report["kept_frames"] = totals.kept;
  report["frames_per_second"] = totals.frames_per_second();
  report["rendered_per_second"] = totals.rendered_per_second();
  report["written_per_second"] = totals.written_per_second();
  report["peak_memory_mib"] = peak_memory_mib();
  report["warnings"] = json_of(warnings);
  return report;
}

}  // namespace hybridrt::cli
