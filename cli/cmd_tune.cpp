// hybridrt tune: the cheapest settings that stay under an error.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/standard_streams.h"
#include "cli/tune/search.h"
#include "cli/warning_output.h"
#include "core/base/output_file.h"

namespace hybridrt::cli {
namespace {

constexpr int kMostFrames = 3;  // to try, and again to check
constexpr int kMostRounds = 3;  // of taking in frames that failed the check

struct TuneOptions {
  RenderOptions render;
  std::string max_error, output;
  std::optional<int> truth_samples;
  bool quiet = false;
};

/// Frames spread over the sequence: those to try, and others to check.
struct SampledFrames {
  std::vector<int> tried, checked;
};

SampledFrames sample_frames(const std::string& spec) {
  const FrameSpec frames = parse_frame_spec(spec);
  std::vector<int> all;
  FrameCursor cursor(frames);
  while (const std::optional<int> frame = cursor.next()) all.push_back(*frame);
  SampledFrames sampled;
  const auto at = [&](double share) { return all[static_cast<size_t>(share * static_cast<double>(all.size() - 1))]; };
  const auto add = [&](std::vector<int>& to, int frame) {
    for (const std::vector<int>* known : {&sampled.tried, &sampled.checked})
      if (std::find(known->begin(), known->end(), frame) != known->end()) return;
    to.push_back(frame);
  };
  for (int i = 0; i < kMostFrames; ++i) add(sampled.tried, at((i + 0.5) / kMostFrames));
  for (int i = 0; i < kMostFrames; ++i) add(sampled.checked, at(i / (kMostFrames - 0.999)));
  return sampled;
}

void refuse_what_is_searched(const RenderOptions& options) {
  for (const auto& [name, value] : options.given)
    for (const char* searched : {"--method", "--shadows", "--blur-kernel", "--shadow-map", "--reflection-depth",
                                 "--samples", "--adaptive", "--accel", "--frames-in-flight"})
      if (name == searched) throw error(ErrorKind::usage, "{} is what tune chooses; leave it out", name);
}

std::string as_json(const Choice& choice) {
  nlohmann::ordered_json object;
  for (const auto& [name, value] : choice) object[name] = value;
  return object.dump(2) + "\n";
}

/// What was tried beside the choice, cheapest first, with what it costs or why it is out.
void print_trials(const Trials& trials, const Goal& goal, const Choice& choice) {
  std::vector<Trial> timed;
  for (const Trial& trial : trials.all())
    if (!trial.times_ms.empty()) timed.push_back(trial);
  std::sort(timed.begin(), timed.end(), [](const Trial& a, const Trial& b) { return a.ms() < b.ms(); });
  say(fmt::format("\n{:>10}  {:<22}  settings\n", "ms a frame", "error"));
  for (const Trial& trial : timed)
    say(fmt::format("{:>10.1f}  {:<22}  {}{}\n", trial.ms(), error_text(goal, trial.error), text_of(trial.choice),
                    trial.choice == choice ? "  <- chosen" : ""));
  for (const Trial& trial : trials.all())
    if (trial.times_ms.empty() && !is_met(goal, trial.error))
      say(fmt::format("{:>10}  {:<22}  {}\n", "too coarse", error_text(goal, trial.error), text_of(trial.choice)));
}

/// The cheapest choice that also does on frames that it was not chosen on; those on which it does not are taken in and
/// the search is repeated.
Choice checked_choice(Trials& trials, const Goal& goal, const TuneOptions& options) {
  SampledFrames frames = sample_frames(options.render.frames);
  for (int round = 1;; ++round) {
    trials.set_frames(frames.tried);
    const Choice choice = cheapest_choice(trials, goal);
    const auto fails = [&](int frame) { return !is_met(goal, trials.error_at(choice, frame)); };
    const auto failed = std::find_if(frames.checked.begin(), frames.checked.end(), fails);
    if (failed == frames.checked.end()) return choice;
    if (round == kMostRounds) {
      warn({WarningCode::error_exceeded,
            fmt::format("frame {} has a larger error; give --frames that are more alike", *failed)});
      return choice;
    }
    if (!options.quiet) say(fmt::format("hybridrt: frame {} needs more: trying again with it\n", *failed));
    frames.tried.push_back(*failed);
    frames.checked.erase(failed);
  }
}

ExitCode tune(const TuneOptions& options) {
  const Goal goal = parse_goal(options.max_error);
  refuse_what_is_searched(options.render);
  if (options.render.scene == "-")
    throw error(ErrorKind::usage, "tune reads its scene several times, and standard input only once; name a file");
  if (!options.output.empty()) require_writable(options.output);
  const int truth_samples = goal.one_sample() ? 1 : options.truth_samples.value_or(64);
  Trials trials(options.render, goal, truth_samples, options.quiet);
  if (!options.output.empty()) trials.files().require_unused(options.output, "-o");
  const Choice choice = checked_choice(trials, goal, options);
  if (!options.quiet) print_trials(trials, goal, choice);
  if (options.output.empty())
    fmt::print("{}", as_json(choice));
  else
    write_file_atomically(options.output, as_json(choice));
  return ExitCode::ok;
}

}  // namespace

void add_tune_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("tune", "Find the cheapest settings that stay under an error");
  auto options = std::make_shared<TuneOptions>();
  add_render_options(*command, options->render);
  const char* group = "Tune";
  command
      ->add_option("--max-error", options->max_error,
                   "45dB: PSNR; 0.1%: of the pixels off by more than 2/255; 10wrong: pixels with another triangle or a "
                   "wrong shadow, at one sample")
      ->type_name("E")
      ->required()
      ->group(group);
  command->add_option("-o,--output", options->output, "JSON for 'render --config' (default: standard output)")
      ->type_name("FILE")
      ->group(group);
  command->add_option("--truth-samples", options->truth_samples, "Samples per pixel of the reference (default 64)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096).description(""))
      ->group(group);
  command->add_flag("-q,--quiet", options->quiet, "Only errors and warnings")->group(group);
  command->footer(
      "Examples:\n"
      "  hybridrt tune car.obj --max-error 40dB --frames 100 --size 1280x720 -o car.tuned.json\n"
      "  hybridrt render car.obj --config car.tuned.json --frames 100 --size 1280x720");
  command->callback([options, &chosen] { chosen = [options] { return tune(*options); }; });
}

}  // namespace hybridrt::cli
