#include "cli/stability/run_stability.h"

#include <cmath>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/job.h"
#include "cli/pass_forms.h"
#include "cli/progress.h"
#include "cli/run_report.h"
#include "cli/stability/measure_failure.h"
#include "cli/sweep/csv.h"
#include "cli/version.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/output_file.h"
#include "core/image_io/encode_image.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string number(double value) { return fmt::format("{:.12g}", value); }
std::string number(std::optional<double> value) { return value ? number(*value) : ""; }
std::string number(std::optional<size_t> value) { return value ? fmt::format("{}", *value) : ""; }

bool fails(const FailurePoint& point) {
  return point.percent_bad() > kMostBad_percent || point.accuracy.non_finite > 0;
}

void write_png(const fs::path& path, const Image& linear) {
  const std::vector<unsigned char> bytes = encode_image(linear, "png");
  write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

/// The files of a run.
class StabilityFiles {
 public:
  explicit StabilityFiles(const fs::path& folder)
      : folder_(folder), points_(folder / "stability.csv"), thresholds_(folder / "thresholds.csv") {
    points_.write(csv_line({"trial", "parameter", "value", "contender", "pixels", "pixels_bad", "percent_bad", "rmse",
                            "max_error", "other_triangle", "false_lit", "false_shadow", "non_finite"}));
    thresholds_.write(csv_line({"trial", "parameter", "contender", "holds_to", "fails_from", "percent_bad", "picture",
                                "truth", "difference"}));
  }

  void add(const FailureSweep& sweep, const FailureMeasurer& measurer) {
    for (const Contender& contender : sweep.contenders)
      for (const auto& [key, point] : measurer.points())
        if (key.first == contender.name) add(sweep, contender, key.second, point);
  }

  void add(const FailureSweep& sweep, const Contender& contender, const Threshold& threshold,
           FailureMeasurer& measurer) {
    std::vector<std::string> row = {sweep.name, sweep.parameter, contender.name, number(threshold.holds_to),
                                    number(threshold.fails_from)};
    if (threshold.fails_from) {
      row.push_back(number(measurer.point(contender, *threshold.fails_from).percent_bad()));
      for (const std::string& file :
           write_pictures(sweep, contender, measurer.pictures(contender, *threshold.fails_from)))
        row.push_back(file);
    } else {
      row.insert(row.end(), 4, "");
    }
    thresholds_.write(csv_line(row));
  }

  void checkpoint() {
    points_.checkpoint();
    thresholds_.checkpoint();
  }

  void finish() {
    points_.commit();
    thresholds_.commit();
  }

 private:
  void add(const FailureSweep& sweep, const Contender& contender, double value, const FailurePoint& point) {
    const Accuracy& a = point.accuracy;
    points_.write(csv_line({sweep.name, sweep.parameter, number(value), contender.name, fmt::format("{}", point.pixels),
                            fmt::format("{}", point.pixels_bad), fmt::format("{:.6g}", point.percent_bad()),
                            fmt::format("{:.6g}", a.rmse), fmt::format("{:.6g}", a.max_error), number(a.other_triangle),
                            number(a.false_lit), number(a.false_shadow), fmt::format("{}", a.non_finite)}));
  }

  std::vector<std::string> write_pictures(const FailureSweep& sweep, const Contender& contender,
                                          const FailurePictures& pictures) const {
    std::string start = fmt::format("pictures/{}.{}", sweep.name, contender.name);
    std::replace(start.begin(), start.end(), ' ', '-');
    const std::vector<std::string> files = {start + ".png", start + ".truth.png", start + ".difference.png"};
    write_png(folder_ / files[0], pictures.picture);
    write_png(folder_ / files[1], pictures.truth);
    write_png(folder_ / files[2], pictures.difference);
    return files;
  }

  const fs::path folder_;
  OutputFile points_, thresholds_;
};

Json json_of(const FailureSweep& sweep) {
  Json contenders = Json::array();
  for (const Contender& contender : sweep.contenders) contenders.push_back(contender.name);
  Json options = Json::array();
  for (const auto& [name, value] : sweep.options) options.push_back("--" + name + " " + value);
  return {{"name", sweep.name},
          {"title", sweep.title},
          {"reason", sweep.reason},
          {"scene", "scene:" + sweep.scene},
          {"parameter", sweep.parameter},
          {"is_option", sweep.parameter_is_option()},
          {"unit", sweep.unit},
          {"values", sweep.values},
          {"options", options},
          {"contenders", contenders},
          {"truth", sweep.same_truth ? "of the first value" : "of each value"},
          {"measure", name_in(kMeasures, sweep.measure)}};
}

Json facts_of(const RenderOptions& base, const std::vector<std::string>& command_line,
              const std::vector<FailureSweep>& sweeps) {
  const RenderSettings settings = finished_settings(base);
  Json trials = Json::array();
  for (const FailureSweep& sweep : sweeps) trials.push_back(json_of(sweep));
  return {{"version", kVersion},
          {"commit", kCommit},
          {"compiler", kCompiler},
          {"processor", processor_name()},
          {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
          {"command_line", command_line},
          {"form", choose_forms(base, settings).forms == PassForms::gl ? "gl" : "cpu"},
          {"width_px", settings.width_px},
          {"height_px", settings.height_px},
          {"most_bad_percent", kMostBad_percent},
          {"trials", trials}};
}

std::string outcome_of(const Threshold& threshold) {
  if (!threshold.fails_from) return "holds";
  if (!threshold.holds_to) return "fails from the start";
  return fmt::format("holds to {:.3g}, fails from {:.3g}", *threshold.holds_to, *threshold.fails_from);
}

}  // namespace

bool run_stability(const std::vector<FailureSweep>& sweeps, const RenderOptions& base,
                   const std::vector<std::string>& command_line, const fs::path& folder, bool quiet) {
  ThreadPool pool(thread_count(base));
  gl::limit_software_threads(pool.size());
  StabilityFiles files(folder);
  write_file_atomically(folder / "stability.json", facts_of(base, command_line, sweeps).dump(2) + "\n");
  Progress progress(static_cast<int64_t>(sweeps.size()), quiet, "trial");
  const FinishingFrames finishing;
  try {
    for (const FailureSweep& sweep : sweeps) {
      FailureMeasurer measurer(sweep, base, pool);
      for (const double value : sweep.values)
        for (const Contender& contender : sweep.contenders) measurer.point(contender, value);
      for (const Contender& contender : sweep.contenders) {
        const Threshold threshold = find_threshold(
            sweep.values, sweep.between, [&](double value) { return fails(measurer.point(contender, value)); });
        files.add(sweep, contender, threshold, measurer);
        if (!quiet) progress.say(fmt::format("{:16} {:14} {}", sweep.name, contender.name, outcome_of(threshold)));
      }
      files.add(sweep, measurer);
      files.checkpoint();
      progress.frame_done();
    }
  } catch (const Stopped&) {
    files.finish();
    return false;
  }
  files.finish();
  return true;
}

}  // namespace hybridrt::cli
