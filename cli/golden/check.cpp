#include <algorithm>
#include <fmt/format.h>

#include "cli/golden/calibration.h"
#include "cli/golden/golden_case.h"
#include "cli/standard_streams.h"
#include "cli/version.h"
#include "core/base/output_file.h"
#include "core/base/timing.h"
#include "core/golden/golden_report.h"
#include "core/image_io/read_image.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kDifferenceAmplification = 20;

/// A case's pictures, in the folder of the report.
struct Pictures {
  fs::path actual, expected, difference;
};
Pictures pictures_of(const fs::path& folder, const std::string& name) {
  return {folder / (name + ".png"), folder / (name + ".expected.png"), folder / (name + ".diff.png")};
}

/// What `check` writes, as far as the list tells. Throws Error(usage) where that is read too, or one file is meant
/// twice. (Pictures of cases with several frames are named after them: what they would overwrite is found then.)
std::vector<GoldenOutput> outputs_of(const GoldenList& list, const GoldenOptions& options) {
  RunFiles files = files_of(list);
  for (const GoldenCase& any : read_golden_list(list.file).cases) files.reads(list.expected(any.name));
  std::vector<GoldenOutput> outputs = {{fs::path(options.output) / "report.html", "the report"}};
  if (!options.junit.empty()) outputs.push_back({options.junit, "--junit"});
  for (const GoldenCase& golden : list.cases) {
    const Pictures pictures = pictures_of(options.output, golden.name);
    outputs.push_back({pictures.actual, "-o: the picture"});
    outputs.push_back({pictures.expected, "-o: the expected picture's copy"});
    outputs.push_back({pictures.difference, "-o: the difference"});
  }
  for (const GoldenOutput& output : outputs) files.writes(output.path, output.what);
  return outputs;
}

class Checker {
 public:
  Checker(const GoldenList& list, const GoldenOptions& options, std::vector<GoldenOutput> outputs)
      : list_(list), options_(options), outputs_(std::move(outputs)) {
    const bool timed = std::ranges::any_of(list.cases, [](const GoldenCase& c) { return c.budget.has_value(); });
    if (timed) calibration_seconds_ = calibration_seconds();
  }

  std::vector<GoldenResult> check(const GoldenCase& golden) {
    std::vector<GoldenResult> results;
    GoldenTime time;
    time.budget = golden.budget;
    const Stopwatch stopwatch;
    try {
      const CaseJob job = make_case_job(golden, options_, outputs_);
      const CaseFacts facts = render_case(golden, job, [&](const std::string& name, const Image& picture) {
        results.push_back(blank(golden, name));
        write_picture(results.back().actual = pictures_of(options_.output, name).actual, picture);
      });
      time.seconds = stopwatch.elapsed_ms() * 1e-3;
      for (GoldenResult& result : results) compare(golden, facts, result);
    } catch (const Error& problem) {
      if (problem.kind() == ErrorKind::output || problem.kind() == ErrorKind::usage) throw;
      results = {blank(golden, golden.name)};
      results[0].failure = problem.what();
      results[0].is_broken = true;
      broken_.push_back({problem.kind(), fmt::format("golden case '{}': {}", golden.name, problem.what())});
    }
    if (calibration_seconds_ > 0) time.calibrations = time.seconds / calibration_seconds_;
    for (GoldenResult& result : results) result.time = time, result.enforce_time = options_.enforce_time;
    return results;
  }

  /// Throws if some cases could not be rendered at all.
  void throw_if_broken() const {
    if (broken_.empty()) return;
    const std::string others =
        broken_.size() == 1 ? "" : fmt::format("; {} more could not be rendered", broken_.size() - 1);
    throw Error(broken_[0].kind, broken_[0].text + others);
  }

 private:
  struct Broken {
    ErrorKind kind;
    std::string text;
  };

  GoldenResult blank(const GoldenCase& golden, const std::string& name) const {
    GoldenResult result;
    result.name = name;
    result.command = golden.scene;
    for (const std::string& option : golden.options) result.command += " " + option;
    result.reason = golden.reason;
    return result;
  }

  /// Errors in the expected picture are a result.
  void compare(const GoldenCase& golden, const CaseFacts& facts, GoldenResult& result) const {
    result.where = facts.where;
    result.limits = golden.limits_for(facts.renderer);
    const fs::path expected = list_.expected(result.name);
    const Pictures pictures = pictures_of(options_.output, result.name);
    try {
      if (!fs::exists(expected))
        throw error(ErrorKind::input, "{} is missing; 'hybridrt golden update {}{}' makes it", expected.string(),
                    repeated(options_), golden.name);
      const Image a = read_image(result.actual), b = read_image(expected);
      write_picture(pictures.expected, b);
      result.expected = pictures.expected;
      result.compared = compare_images(a, b, result.limits);
      if (!result.compared.measured || result.compared.max_error == 0) return;
      write_picture(pictures.difference, difference_image(a, b, kDifferenceAmplification));
      result.difference = pictures.difference;
    } catch (const Error& problem) {
      if (problem.kind() == ErrorKind::output) throw;
      result.failure = problem.what();
    }
  }

  const GoldenList& list_;
  const GoldenOptions& options_;
  const std::vector<GoldenOutput> outputs_;
  double calibration_seconds_ = 0;  ///< 0: no case has a budget
  std::vector<Broken> broken_;
};

void print(const GoldenResult& result) {
  const char* const state = result.is_broken ? "BROKEN" : result.passed() ? "ok    " : "FAILED";
  fmt::print("{}  {:<24} {:5.1f} s  {}\n", state, in_one_line(result.name), result.time.seconds,
             in_one_line(result.verdict()));
  flush_output();
}

void make_folder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) throw error(ErrorKind::output, "cannot make the folder {}: {}", folder.string(), problem.message());
}

/// Throws Error(usage) if it is the list; then no old one is left, whatever ends the run.
void clear_junit(const GoldenOptions& options) {
  if (options.junit.empty()) return;
  RunFiles files;
  files.reads(list_of(options));
  files.require_unused(options.junit, "--junit");
  std::error_code problem;
  if (fs::is_regular_file(options.junit, problem)) fs::remove(options.junit, problem);
}

void write_junit(const GoldenOptions& options, std::span<const GoldenResult> results) {
  if (!options.junit.empty()) write_file_atomically(options.junit, golden_junit(results));
}

/// What a CI server gets if there are no cases to tell of.
void write_junit_of(const GoldenOptions& options, const Error& problem) {
  GoldenResult result;
  result.name = "golden list";
  result.failure = problem.what();
  result.is_broken = true;
  write_junit(options, {&result, 1});
}

ExitCode check_list(const GoldenOptions& options, std::vector<GoldenResult>& results) {
  GoldenList list = read_golden_list(list_of(options));
  keep_cases(list, options.names);
  Checker checker(list, options, outputs_of(list, options));
  clear_junit(options);
  make_folder(options.output);
  for (const GoldenCase& golden : list.cases)
    for (GoldenResult& result : checker.check(golden)) {
      print(result);
      results.push_back(std::move(result));
    }
  const fs::path report = fs::path(options.output) / "report.html";
  write_file_atomically(report, golden_html(results, fmt::format("hybridrt {} ({})", kVersion, kCommit)));
  write_junit(options, results);
  const auto passed = std::ranges::count_if(results, [](const GoldenResult& r) { return r.passed(); });
  fmt::print("{} of {} as expected; report: {}\n", passed, results.size(), report.string());
  flush_output();
  checker.throw_if_broken();
  return static_cast<size_t>(passed) < results.size() ? ExitCode::images_differ : ExitCode::ok;
}

}  // namespace

ExitCode golden_check(const GoldenOptions& options) {
  std::vector<GoldenResult> results;
  try {
    return check_list(options, results);
  } catch (const Error& problem) {
    // A command line that is refused touches nothing.
    if (results.empty() && problem.kind() != ErrorKind::usage) {
      clear_junit(options);
      write_junit_of(options, problem);
    }
    throw;
  }
}

}  // namespace hybridrt::cli
