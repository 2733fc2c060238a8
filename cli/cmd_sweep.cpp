#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/files_read.h"
#include "cli/interrupt.h"
#include "cli/option_values.h"
#include "cli/stability/run_stability.h"
#include "cli/standard_streams.h"
#include "cli/sweep/charts.h"
#include "cli/sweep/machine_load.h"
#include "cli/sweep/presets.h"
#include "cli/sweep/run_sweep.h"
#include "cli/sweep/sweep_files.h"
#include "cli/warning_output.h"
#include "core/base/file_claims.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kBusy = 0.1;  // of the machine, by others

struct SweepOptions {
  RenderOptions render;
  std::vector<std::string> over;
  std::string preset, folder, truth;
  std::optional<int> truth_samples;
  int rounds = 3;
  int settle_s = 0;
  bool memory = false, no_charts = false, quiet = false;
};

bool is_given(const RenderOptions& options, const std::string& name) {
  return std::any_of(options.given.begin(), options.given.end(), [&](const auto& o) { return o.first == name; });
}

/// The command line with what its preset adds.
SweepOptions with_preset(SweepOptions options) {
  if (options.preset.empty()) {
    if (options.over.empty())
      throw error(ErrorKind::usage, "sweep: say what over: --over AXIS=VALUES, or --preset {}", names_in(kPresets));
    return options;
  }
  const Preset preset = parse_name("--preset", kPresets, options.preset);
  const PresetOptions adds = preset_options(preset, options.render.scene, allowed_processors());
  for (const std::string& axis : adds.over) {
    const std::string start = axis.substr(0, axis.find('=') + 1);
    const bool overridden =
        std::any_of(options.over.begin(), options.over.end(), [&](const auto& o) { return o.starts_with(start); });
    if (!overridden && !is_given(options.render, "--" + start.substr(0, start.size() - 1)))
      options.over.push_back(axis);
  }
  for (const auto& [name, value] : adds.options)
    if (!is_given(options.render, name)) set_render_option(options.render, name, value);
  if (!options.truth_samples) options.truth_samples = adds.truth_samples;
  options.memory |= adds.memory;
  return options;
}

/// The scene first, as parameters follow it; then what else changes scenes, then views: what is loaded or true for
/// several settings is at hand for all of them.
std::vector<Axis> axes_of(const SweepOptions& options) {
  std::vector<Axis> axes;
  for (const std::string& text : options.over) {
    axes.push_back(parse_axis(text, options.render.scene));
    const Axis& last = axes.back();
    if (std::count_if(axes.begin(), axes.end(), [&](const Axis& a) { return a.name == last.name; }) > 1)
      throw error(ErrorKind::usage, "--over {}: that axis is given twice; give all its values at once", text);
    if (is_given(options.render, "--" + last.name))
      throw error(ErrorKind::usage, "--{} and --over {}: give one of them", last.name, text);
  }
  std::stable_sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) {
    const bool a_is_scene = a.name == "scene", b_is_scene = b.name == "scene";
    return a_is_scene != b_is_scene ? a_is_scene : a.affects > b.affects;
  });
  return axes;
}

SweepRequest request_of(const SweepOptions& options, const std::vector<std::string>& command_line) {
  SweepRequest request;
  request.command_line = command_line;
  request.base = options.render;
  request.axes = axes_of(options);
  request.preset = options.preset;
  request.rounds = options.rounds;
  request.memory = options.memory;
  request.truth.samples = options.truth_samples.value_or(request.truth.samples);
  request.truth.folder = options.truth;
  request.folder = options.folder;
  return request;
}

/// How busy others keep the machine. Warns if they do; with --settle waits first, and throws Error(device) in vain.
double require_quiet_machine(const SweepOptions& options) {
  const double busy = wait_until_quiet(kBusy, options.settle_s);
  if (busy < kBusy || stop_requested()) return busy;
  const std::string message = fmt::format("others use {:.0f} % of this machine; times will be unsteady", 100 * busy);
  if (options.settle_s > 0)
    throw error(ErrorKind::device, "{}, and --settle {} was not enough; stop them or try later", message,
                options.settle_s);
  warn({WarningCode::machine_busy, message});
  return busy;
}

void claim_rows(FileClaims& claims, const fs::path& rows) {
  if (claims.claim(rows) == FileClaims::Answer::taken)
    throw error(ErrorKind::output, "another run is writing {}; wait for it, or choose another folder for -o",
                rows.string());
}

/// Without them the rows stand.
void draw_charts_if_possible(const fs::path& folder, bool quiet) {
  try {
    draw_charts(folder, quiet);
  } catch (const Error& problem) {
    complain(problem.what());
  }
}

constexpr const char* kStabilitySize = "384x288";

/// --preset stability: scenes of its own, errors only.
ExitCode measure_stability(const SweepOptions& given, const std::vector<std::string>& command_line) {
  require_free_options(given.render);
  if (!given.over.empty() || given.truth_samples || !given.truth.empty())
    throw error(ErrorKind::usage, "--preset stability has axes and truths of its own; leave --over and --truth out");
  const std::vector<FailureSweep> sweeps = failure_sweeps(given.render.scene);
  RenderOptions base = given.render;
  if (!is_given(base, "--size")) set_render_option(base, "--size", kStabilitySize);
  FileClaims claims;
  claim_rows(claims, fs::path(given.folder) / "stability.csv");
  if (!run_stability(sweeps, base, command_line, given.folder, given.quiet)) return interrupted_or(ExitCode::ok);
  if (!given.no_charts) draw_charts_if_possible(given.folder, given.quiet);
  return ExitCode::ok;
}

ExitCode sweep(const SweepOptions& given, const std::vector<std::string>& command_line) {
  if (given.preset == name_in(kPresets, Preset::stability)) return measure_stability(given, command_line);
  if (given.render.scene.empty())
    throw error(ErrorKind::usage, "sweep: which SCENE? Only --preset stability has its own");
  if (given.render.scene == "-" || given.render.input_format)
    throw error(ErrorKind::usage, "a sweep reads its scene several times, and standard input only once; name a file");
  const SweepOptions options = with_preset(given);
  const SweepRequest request = request_of(options, command_line);
  const SweepSettings settings = make_sweep_settings(request.base, request.axes);
  if (!options.quiet && !settings.left_out.empty())
    say(fmt::format("hybridrt: render refuses {} of {} combinations, which are left out: {}\n",
                    settings.left_out.size(), settings.left_out.size() + settings.settings.size(),
                    fmt::join(settings.left_out, ", ")));
  RunFiles read;
  for (const SweepSetting& setting : settings.settings) add_files_read(setting.options, *setting.source, read);
  require_sweep_writes_none_of(read, request);
  FileClaims claims;
  claim_rows(claims, request.rows());
  const double busy = require_quiet_machine(options);
  const SweepOutcome outcome = run_sweep(request, settings, busy, options.quiet);
  if (outcome.stopped) {
    say(fmt::format("hybridrt: stopped; the same command goes on from {}\n", request.rows().string()));
    return interrupted_or(ExitCode::ok);
  }
  if (!options.quiet) fmt::print("rows     {}\n", request.rows().string());
  if (!options.no_charts) draw_charts_if_possible(request.folder, options.quiet);
  return outcome.failed > 0 ? ExitCode::some_failed : ExitCode::ok;
}

}  // namespace

void add_sweep_command(CLI::App& app, const std::vector<std::string>& command_line, Command& chosen) {
  CLI::App* command = app.add_subcommand("sweep", "Measure time and error over options; write rows, charts, a report");
  auto options = std::make_shared<SweepOptions>();
  add_render_options(*command, options->render);
  command->get_option("scene")->required(false);
  const char* group = "Sweep";
  command
      ->add_option("--over", options->over,
                   "Any render option, scene, or triangles or reflective of a scene:NAME: A,B,C or FIRST:LAST:STEP or "
                   "FIRST:LAST:*FACTOR; values that hold commas are separated by ;. Several --over multiply")
      ->type_name("AXIS=VALUES")
      ->take_all()
      ->allow_extra_args(false)
      ->group(group);
  command->add_option("--preset", options->preset, names_in(kPresets) + ": a chart that people want")
      ->type_name("NAME")
      ->group(group);
  command->add_option("-o,--output", options->folder, "Folder; run again, it measures only what is missing")
      ->type_name("DIR")
      ->required()
      ->group(group);
  command->add_option("--rounds", options->rounds, "How often each setting is measured, in turns (default 3)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000).description(""))
      ->group(group);
  command
      ->add_option("--truth-samples", options->truth_samples,
                   "Samples per pixel of the reference that errors are measured against; 1: the methods' own errors, "
                   "without aliasing; 0: none are measured (default 64, or the preset's)")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""))
      ->group(group);
  command->add_option("--truth", options->truth, "Folder of pictures to measure against, named by frame numbers")
      ->type_name("DIR")
      ->group(group);
  command->add_option("--settle", options->settle_s, "Wait so long for a quiet machine, else refuse (default: warn)")
      ->type_name("SECONDS")
      ->check(CLI::Range(0, 86400).description(""))
      ->group(group);
  command
      ->add_flag("--memory", options->memory,
                 "Also measure peaks of memory; scenes then follow one another, and share no rounds")
      ->group(group);
  command->add_flag("--no-charts", options->no_charts, "Write rows and pictures only")->group(group);
  command->add_flag("-q,--quiet", options->quiet, "Only errors and warnings")->group(group);
  command->footer(
      "Examples:\n"
      "  hybridrt sweep scene:chess --preset pareto -o out/pareto\n"
      "  hybridrt sweep car.obj --over reflection-percent=0:100:10 --over method=hybrid,raytrace -o out/mirrors\n"
      "  hybridrt sweep --preset stability -o out/stability");
  command->callback([options, command_line, &chosen] { chosen = [=] { return sweep(*options, command_line); }; });
}

}  // namespace hybridrt::cli
