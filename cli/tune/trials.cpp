#include "cli/tune/trials.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "cli/files_read.h"
#include "cli/standard_streams.h"
#include "cli/sweep/visit.h"
#include "cli/warning_output.h"
#include "core/base/error.h"

namespace hybridrt::cli {
namespace {

constexpr int kRounds = 3;  // of a time

/// The command line with a choice and with these frames of its sequence.
SweepSetting setting_of(const RenderOptions& base, const Choice& choice, const std::vector<int>& frames,
                        const std::shared_ptr<const SceneSource>& source) {
  SweepSetting setting;
  setting.options = base;
  for (const auto& [name, value] : choice) set_render_option(setting.options, "--" + name, value);
  setting.options = with_scene_settings(setting.options, *source);
  const FrameSpec whole = parse_frame_spec(setting.options.frames);
  if (!setting.options.sequence) setting.options.sequence = FrameRange{whole.lowest(), whole.highest(), 1};
  std::string spec;
  for (int frame : frames) spec += fmt::format("{}{}-{}", spec.empty() ? "" : ",", frame, frame);
  if (!spec.empty()) setting.options.frames = spec;
  setting.source = source;
  return setting;
}

}  // namespace

double Trial::ms() const {
  if (times_ms.empty()) return 0;
  std::vector<double> sorted = times_ms;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2];
}

Trials::Trials(const RenderOptions& base, const Goal& goal, int truth_samples, bool quiet)
    : base_(base),
      goal_(goal),
      truth_samples_(truth_samples),
      quiet_(quiet),
      source_(std::make_shared<const SceneSource>(parse_scene_source(base.scene))),
      truths_({truth_samples, {}}, {}, [quiet](const std::string& line) {
        if (!quiet) say("hybridrt: " + line + "\n");
      }) {
  const SweepSetting setting = setting_of(base, {}, {}, source_);
  const int threads = thread_count(setting.options);
  gl::limit_software_threads(threads);
  pool_ = std::make_unique<ThreadPool>(threads);
  Warnings warnings;
  scene_ = load_scene_of(setting, *pool_, warnings);
  set_job(scene_, setting, *pool_, warnings);
  add_files_read(setting.options, *source_, files_);
  add_files_read(scene_.job.scene, files_);
  for (const Warning& warning : warnings) warn(warning);
}

void Trials::set_frames(const std::vector<int>& frames) {
  frames_ = frames;
  std::sort(frames_.begin(), frames_.end());
  trials_.clear();
}

Trial& Trials::find(const Choice& choice) {
  const auto known =
      std::find_if(trials_.begin(), trials_.end(), [&](const Trial& trial) { return trial.choice == choice; });
  if (known != trials_.end()) return *known;
  return trials_.emplace_back(Trial{choice, NAN, {}});
}

void Trials::set_job_of(const Choice& choice, const std::vector<int>& frames) {
  Warnings told_already;
  set_job(scene_, setting_of(base_, choice, frames, source_), *pool_, told_already);
}

double Trials::worst_error() {
  const std::vector<Truth>& truths = truths_.of(scene_.job, *pool_);
  const std::vector<Frame> frames = render_to_compare(scene_.job, *pool_);
  double worst = -INFINITY;
  for (size_t i = 0; i < frames.size(); ++i)
    worst = std::max(worst, error_of(goal_, measure_accuracy(frames[i], truths[i]), frames[i].picture.pixel_count()));
  return worst;
}

double Trials::error(const Choice& choice) {
  Trial& trial = find(choice);
  if (!std::isnan(trial.error)) return trial.error;
  set_job_of(choice, frames_);
  trial.error = worst_error();
  if (!quiet_) say(fmt::format("hybridrt: {}: {}\n", text_of(choice), error_text(goal_, trial.error)));
  return trial.error;
}

double Trials::error_at(const Choice& choice, int frame) {
  set_job_of(choice, {frame});
  return worst_error();
}

void Trials::measure(const std::vector<Choice>& choices) {
  for (int round = 0; round < kRounds; ++round)
    for (const Choice& choice : choices) {
      set_job_of(choice, frames_);
      const Visit visit = hybridrt::cli::measure(scene_.job, *pool_);
      for (const Frame& frame : visit.frames) find(choice).times_ms.push_back(frame.timings.wall_ms);
    }
  if (quiet_) return;
  for (const Choice& choice : choices) say(fmt::format("hybridrt: {}: {:.1f} ms\n", text_of(choice), ms(choice)));
}

std::string text_of(const Choice& choice) {
  std::string text;
  for (const auto& [name, value] : choice)
    text += fmt::format("{}--{}{}", text.empty() ? "" : " ", name, value == "true" ? "" : " " + value);
  return text;
}

}  // namespace hybridrt::cli
