#include "core/render/frame_columns.h"

#include <fmt/format.h>
#include <functional>

namespace hybridrt {
namespace {

/// A column's name and its value.
struct Column {
  std::string name;
  std::function<std::string(const FrameTimings&, const TraceStats&)> text;
};

std::string milliseconds(double ms) { return fmt::format("{:.3f}", ms); }

Column count(std::string name, int64_t TraceStats::*member) {
  return {std::move(name), [member](const FrameTimings&, const TraceStats& s) { return fmt::format("{}", s.*member); }};
}

Column duration(std::string name, double TraceStats::*member) {
  return {std::move(name), [member](const FrameTimings&, const TraceStats& s) { return milliseconds(s.*member); }};
}

std::vector<Column> make_columns() {
  std::vector<Column> columns;
  for (size_t pass = 0; pass < kPassNames.size(); ++pass)
    columns.push_back({fmt::format("{}_ms", kPassNames[pass]),
                       [pass](const FrameTimings& t, const TraceStats&) { return milliseconds(t.pass_ms[pass]); }});
  columns.push_back({"wall_ms", [](const FrameTimings& t, const TraceStats&) { return milliseconds(t.wall_ms); }});
  for (auto& column :
       {count("pixels_hit", &TraceStats::pixels_hit), count("pixels_marked", &TraceStats::pixels_marked),
        count("pixels_reflective", &TraceStats::pixels_reflective),
        count("pixels_refractive", &TraceStats::pixels_refractive), count("shadow_rays", &TraceStats::shadow_rays),
        count("reflection_rays", &TraceStats::reflection_rays), count("refraction_rays", &TraceStats::refraction_rays),
        duration("shadow_cpu_ms", &TraceStats::shadow_cpu_ms),
        duration("secondary_cpu_ms", &TraceStats::secondary_cpu_ms),
        count("primary_shadow_rays", &TraceStats::primary_shadow_rays), duration("repair_ms", &TraceStats::repair_ms),
        count("pixels_suspect", &TraceStats::pixels_suspect), count("pixels_repaired", &TraceStats::pixels_repaired),
        count("pixels_resampled", &TraceStats::pixels_resampled)})
    columns.push_back(column);
  for (const PassId pass : {PassId::id, PassId::mark, PassId::trace, PassId::shade}) {
    const auto i = static_cast<size_t>(pass);
    columns.push_back({fmt::format("{}_cpu_ms", kPassNames[i]),
                       [i](const FrameTimings& t, const TraceStats&) { return milliseconds(t.threads_ms[i]); }});
  }
  return columns;
}

const std::vector<Column>& columns() {
  static const std::vector<Column> made = make_columns();
  return made;
}

}  // namespace

std::vector<std::string> frame_columns() {
  std::vector<std::string> names;
  for (const Column& column : columns()) names.push_back(column.name);
  return names;
}

std::vector<std::string> frame_cells(const FrameTimings& timings, const TraceStats& stats) {
  std::vector<std::string> cells;
  for (const Column& column : columns()) cells.push_back(column.text(timings, stats));
  return cells;
}

}  // namespace hybridrt
