#include "cli/sweep/rows.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/load/text_scan.h"
#include "core/render/frame_columns.h"
#include "core/render/samples.h"

namespace hybridrt::cli {
namespace {

using Row = std::vector<std::string>;

const std::vector<std::string> kSettings = {
    "scene",       "width_px",         "height_px", "method",   "shadows", "blur_kernel_px", "shadow_map_px",
    "shadow_warp", "reflection_depth", "samples",   "adaptive", "accel",   "threads",        "frames_in_flight",
    "form",        "triangles"};
const std::vector<std::string> kOneOff = {"first_frame_ms", "first_shadow_map_ms", "ready_ms", "load_ms",
                                          "accel_build_ms", "peak_memory_mib",     "pixels"};
const std::vector<std::string> kAccuracy = {"rmse",         "psnr_db",          "max_error",
                                            "ssim",         "pixels_different", "false_lit",
                                            "false_shadow", "other_triangle",   "non_finite"};

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

bool is_setting_column(const std::string& name) {
  return std::find(kSettings.begin(), kSettings.end(), name) != kSettings.end();
}

/// Of frame_columns() or frame_cells(): nothing is written while times are taken.
std::vector<std::string> without_writing(std::vector<std::string> cells) {
  cells.erase(cells.begin() + static_cast<ptrdiff_t>(PassId::write));
  return cells;
}

std::vector<std::string> header_for(const std::vector<Axis>& axes) {
  std::vector<std::string> header = {"setting", "round", "frame"};
  for (const Axis& axis : axes)
    if (!is_setting_column(axis.column())) header.push_back(axis.column());
  append(header, kSettings);
  append(header, kOneOff);
  append(header, without_writing(frame_columns()));
  append(header, kAccuracy);
  header.push_back("error");
  return header;
}

std::string milliseconds(double ms) { return fmt::format("{:.3f}", ms); }

Row start_of_row(const SweepSetting& setting, const std::vector<Axis>& axes, int round, const std::string& frame) {
  Row row = {fmt::format("{}", setting.number), fmt::format("{}", round), frame};
  for (size_t a = 0; a < axes.size(); ++a)
    if (!is_setting_column(axes[a].column())) row.push_back(setting.values[a]);
  return row;
}

Row settings_cells(const RowContext& context) {
  const RenderSettings& s = context.job.settings;
  const bool has_form = s.method == Method::hybrid || s.method == Method::raster;
  const auto number = [](auto n) { return fmt::format("{}", n); };
  return {context.setting.options.scene,
          number(s.width_px),
          number(s.height_px),
          std::string(name_of(s.method)),
          std::string(name_of(s.shadows)),
          number(s.blur_kernel_px),
          number(s.shadow_map_px),
          std::string(name_of(s.shadow_warp)),
          number(s.reflection_depth),
          number(s.samples),
          s.adaptive ? "true" : "false",
          std::string(name_of(s.accel)),
          number(context.threads),
          number(s.frames_in_flight),
          has_form && s.forms == PassForms::gl ? "gl" : "cpu",
          number(context.job.scene.triangle_count())};
}

Row one_off_cells(const RowContext& context, const Visit& visit) {
  const RenderSettings& settings = context.job.settings;
  const PixelRect picture = picture_rect(settings);
  return {milliseconds(visit.first_frame_ms),
          milliseconds(visit.first_shadow_map_ms),
          milliseconds(visit.facts.ready_ms),
          milliseconds(context.load_ms),
          milliseconds(visit.facts.accel_build_ms),
          context.peak_bytes ? fmt::format("{:.1f}", static_cast<double>(context.peak_bytes) / (1 << 20)) : "",
          fmt::format("{}", samples_taken(settings, int64_t{picture.width_px} * picture.height_px, 0))};
}

int number_in(const std::string& cell, const std::filesystem::path& file) {
  const std::optional<double> number = parse_number(cell);
  if (!number || *number != std::floor(*number) || !(std::abs(*number) < 1e9))
    throw error(ErrorKind::input, "{}: '{}' should be the number of a setting or round; restore the file or remove it",
                file.string(), in_one_line(cell));
  return static_cast<int>(*number);
}

}  // namespace

AccuracyCells accuracy_cells(const std::optional<Accuracy>& a) {
  if (!a) return AccuracyCells(kAccuracy.size());
  const auto count = [](std::optional<size_t> n) { return n ? fmt::format("{}", *n) : std::string(); };
  return {fmt::format("{:.6g}", a->rmse),
          std::isfinite(a->psnr_db) ? fmt::format("{:.3f}", a->psnr_db) : "inf",
          fmt::format("{:.6g}", a->max_error),
          fmt::format("{:.7f}", a->ssim),
          count(a->pixels_different),
          count(a->false_lit),
          count(a->false_shadow),
          count(a->other_triangle),
          count(a->non_finite)};
}

SweepRows::SweepRows(const std::filesystem::path& file, const std::vector<Axis>& axes, size_t frames_per_visit)
    : header_(header_for(axes)), file_(file) {
  file_.write(csv_line(header_));
  if (!std::filesystem::exists(file)) return;
  const CsvTable earlier = read_csv(file);
  if (earlier.header != header_)
    throw error(ErrorKind::input, "{}: has other columns than this sweep; choose another folder, or remove it",
                file.string());
  for (auto at = earlier.rows.begin(); at != earlier.rows.end();) {
    const auto end =
        std::find_if(at, earlier.rows.end(), [&](const Row& row) { return row[0] != (*at)[0] || row[1] != (*at)[1]; });
    if (static_cast<size_t>(end - at) == frames_per_visit && at->back().empty())
      append({number_in((*at)[0], file), number_in((*at)[1], file)}, {at, end});
    at = end;
  }
}

std::vector<AccuracyCells> SweepRows::accuracy_of(int setting) const {
  const auto first = visits_.lower_bound({setting, 0});
  if (first == visits_.end() || first->first.first != setting) return {};
  std::vector<AccuracyCells> cells;
  for (const Row& row : first->second)
    cells.emplace_back(row.end() - 1 - static_cast<ptrdiff_t>(kAccuracy.size()), row.end() - 1);
  return cells;
}

void SweepRows::add(const RowContext& context, int round, const Visit& visit,
                    const std::vector<AccuracyCells>& accuracy) {
  std::vector<Row> rows;
  for (size_t i = 0; i < visit.frames.size(); ++i) {
    Row row = start_of_row(context.setting, context.axes, round, fmt::format("{}", visit.frames[i].number));
    cli::append(row, settings_cells(context));
    cli::append(row, one_off_cells(context, visit));
    cli::append(row, without_writing(frame_cells(visit.frames[i].timings, visit.frames[i].stats)));
    cli::append(row, accuracy[i]);
    row.emplace_back();  // no error
    rows.push_back(std::move(row));
  }
  append({context.setting.number, round}, rows);
}

void SweepRows::add_failure(const SweepSetting& setting, const std::vector<Axis>& axes, int round,
                            const std::string& reason) {
  Row row = start_of_row(setting, axes, round, "");
  row.resize(header_.size());
  for (size_t a = 0; a < axes.size(); ++a)  // those that the settings' columns hold
    if (const auto at = std::find(header_.begin(), header_.end(), axes[a].column()); at != header_.end())
      row[static_cast<size_t>(at - header_.begin())] = setting.values[a];
  row.back() = reason;
  ++failures_;
  file_.write(csv_line(row));
  file_.checkpoint();
}

void SweepRows::append(std::pair<int, int> visit, const std::vector<Row>& rows) {
  visits_[visit] = rows;
  for (const Row& row : rows) file_.write(csv_line(row));
  file_.checkpoint();
}

}  // namespace hybridrt::cli
