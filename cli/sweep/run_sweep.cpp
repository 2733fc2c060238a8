#include "cli/sweep/run_sweep.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/files_read.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/sweep/facts_file.h"
#include "cli/sweep/rows.h"
#include "cli/sweep/sweep_files.h"
#include "cli/warning_output.h"
#include "core/base/memory.h"
#include "core/image_io/encode_image.h"
#include "core/render/memory_estimate.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

/// A scene and the settings that share it.
struct Group {
  LoadedScene scene;
  std::vector<const SweepSetting*> settings;
};

void write_png(const fs::path& path, const Image& linear) {
  const std::vector<unsigned char> bytes = encode_image(linear, "png");
  write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

/// A sweep under way.
class Sweep {
 public:
  Sweep(const SweepRequest& request, const SweepSettings& settings, double busy, bool quiet)
      : request_(request),
        facts_(request, settings, busy),
        rows_(request.rows(), request.axes, static_cast<size_t>(parse_frame_spec(request.base.frames).count())),
        truths_(request.truth, request.folder / "truth",
                [this, quiet](const std::string& line) {
                  if (!quiet) progress_.say("hybridrt: " + line);
                }),
        progress_(count_missing(settings), quiet, "setting") {
    facts_.write();
  }

  SweepOutcome run(const std::vector<std::vector<const SweepSetting*>>& groups) {
    std::vector<Group> batch;
    uint64_t batch_bytes = 0;
    for (const auto& settings : groups) {
      if (stop_requested()) break;
      if (!is_missing_any(settings)) continue;
      if (request_.memory) {
        measure_batch(batch);
        batch.clear();
        restart_peak_memory();
      }
      std::optional<Group> group = load(settings, groups.size() == 1);
      if (!group) continue;
      const uint64_t bytes = bytes_of(group->scene.job);
      if (!batch.empty() && batch_bytes + bytes > group->scene.job.most_bytes / 2) {
        measure_batch(batch);
        batch.clear();
        batch_bytes = 0;
      }
      batch_bytes += bytes;
      batch.push_back(std::move(*group));
    }
    measure_batch(batch);
    rows_.finish();
    facts_.write();
    return {failed_.size(), stop_requested()};
  }

 private:
  int64_t count_missing(const SweepSettings& settings) const {
    int64_t missing = 0;
    for (const SweepSetting& setting : settings.settings)
      for (int round = 1; round <= request_.rounds; ++round) missing += !rows_.has(setting.number, round);
    return missing;
  }

  bool is_missing_any(const std::vector<const SweepSetting*>& settings) const {
    for (const SweepSetting* setting : settings)
      for (int round = 1; round <= request_.rounds; ++round)
        if (!rows_.has(setting->number, round)) return true;
    return false;
  }

  uint64_t bytes_of(const RenderJob& job) const {
    return estimate_memory(job.scene, job.facts, job.topology, job.sheets, job.settings, 1, /*light_moves=*/true,
                           pool_->size(), job.frames.count())
        .total();
  }

  /// A pool of the setting's threads. A software GL may start as many; it is told while no other thread runs.
  ThreadPool& pool_for(const SweepSetting& setting) {
    const int threads = thread_count(setting.options);
    if (pool_ && pool_->size() == threads) return *pool_;
    pool_.reset();
    gl::limit_software_threads(threads);
    pool_ = std::make_unique<ThreadPool>(threads);
    return *pool_;
  }

  void tell(const Warnings& warnings) {
    for (const Warning& warning : warnings)
      if (const std::string line = line_of(warning); told_.insert(line).second) progress_.say(line);
  }

  void fail(const SweepSetting& setting, const std::string& reason) {
    failed_.insert(setting.number);
    for (int round = 1; round <= request_.rounds; ++round)
      if (!rows_.has(setting.number, round)) progress_.frame_done();
    rows_.add_failure(setting, request_.axes, 1, reason);
    progress_.say(fmt::format("hybridrt: setting {} ({}) failed: {}", setting.number, setting.label, reason));
  }

  /// Nothing if the scene cannot be loaded; then its settings have failed.
  std::optional<Group> load(const std::vector<const SweepSetting*>& settings, bool is_only_scene) {
    Warnings warnings;
    try {
      ThreadPool& pool = pool_for(*settings.front());
      Group group{load_scene_of(*settings.front(), pool, warnings), settings};
      RunFiles read;
      add_files_read(group.scene.job.scene, read);
      require_sweep_writes_none_of(read, request_);
      tell(warnings);
      if (request_.memory) group.scene.making_peak_bytes = peak_memory_bytes();
      return group;
    } catch (const Error& problem) {
      if (is_only_scene) throw;
      for (const SweepSetting* setting : settings) fail(*setting, problem.what());
      return std::nullopt;
    }
  }

  void measure_batch(std::vector<Group>& batch) {
    const FinishingFrames finishing;
    for (int round = 1; round <= request_.rounds; ++round)
      for (Group& group : batch)
        for (const SweepSetting* setting : group.settings) {
          if (stop_requested()) return;
          if (rows_.has(setting->number, round) || failed_.contains(setting->number)) continue;
          try {
            visit(group.scene, *setting, round);
          } catch (const Error& problem) {
            if (problem.kind() == ErrorKind::output) throw;
            fail(*setting, problem.what());
          } catch (const std::bad_alloc&) {
            fail(*setting, "out of memory");
          }
        }
  }

  void visit(LoadedScene& scene, const SweepSetting& setting, int round) {
    Warnings warnings;
    ThreadPool& pool = pool_for(setting);
    const bool fresh = request_.memory && restart_peak_memory();
    set_job(scene, setting, pool, warnings);
    if (fresh) scene.making_peak_bytes = std::max(scene.making_peak_bytes, peak_memory_bytes());
    tell(warnings);
    require_gl_threads(scene.job);
    std::vector<AccuracyCells> accuracy = rows_.accuracy_of(setting.number);
    if (accuracy.empty()) accuracy = find_accuracy(scene.job, setting, pool);
    if (fresh) restart_peak_memory();
    const Visit visit = measure(scene.job, pool);
    const uint64_t peak_bytes = fresh ? std::max(scene.making_peak_bytes, peak_memory_bytes()) : 0;
    if (stop_requested()) return;
    if (visit.facts.gl) {
      facts_.set_gl_renderer(visit.facts.gl->renderer);
      if (visit.facts.gl->software) software_gl_threads_ = pool.size();
    }
    rows_.add({setting, request_.axes, scene.job, scene.load_ms, pool.size(), peak_bytes}, round, visit, accuracy);
    progress_.frame_done();
  }

  /// A software GL starts its threads once per process.
  void require_gl_threads(const RenderJob& job) const {
    if (uses_gl(job.settings) && software_gl_threads_.value_or(pool_->size()) != pool_->size())
      throw error(ErrorKind::usage,
                  "a software OpenGL keeps the {} threads that it began with; give each number of threads a sweep of "
                  "its own, by --threads",
                  *software_gl_threads_);
  }

  /// Renders the frames once more than for their times, with the AOVs that tell where shadows and ids are wrong, and
  /// keeps the first one's picture. Fewer cells if a signal asks to stop.
  std::vector<AccuracyCells> find_accuracy(RenderJob& job, const SweepSetting& setting, ThreadPool& pool) {
    const std::vector<Truth>& truths = truths_.of(job, pool);
    const std::vector<Frame> frames = render_to_compare(job, pool);
    std::vector<AccuracyCells> cells;
    for (size_t i = 0; i < frames.size(); ++i)
      cells.push_back(
          accuracy_cells(i < truths.size() ? std::optional(measure_accuracy(frames[i], truths[i])) : std::nullopt));
    if (!frames.empty() && !stop_requested())
      keep_pictures(setting, frames.front(), truths.empty() ? nullptr : &truths.front());
    return cells;
  }

  void keep_pictures(const SweepSetting& setting, const Frame& frame, const Truth* truth) {
    const std::string name = fmt::format("{:04}", setting.number);
    SettingPictures pictures;
    pictures.picture = fmt::format("pictures/{}.png", name);
    write_png(request_.folder / pictures.picture, frame.picture);
    if (truth) {
      pictures.difference = fmt::format("pictures/{}.difference.png", name);
      write_png(request_.folder / pictures.difference, amplified_difference(frame, *truth));
      pictures.truth = fs::proximate(truth->file, request_.folder).string();
    }
    facts_.set_pictures(setting.number, pictures);
    facts_.write();
  }

  const SweepRequest& request_;
  FactsFile facts_;
  SweepRows rows_;
  TruthStore truths_;
  Progress progress_;
  std::unique_ptr<ThreadPool> pool_;
  std::optional<int> software_gl_threads_;
  std::set<std::string> told_;
  std::set<int> failed_;
};

}  // namespace

SweepOutcome run_sweep(const SweepRequest& request, const SweepSettings& settings, double busy, bool quiet) {
  std::vector<std::vector<const SweepSetting*>> groups;
  std::map<std::string, size_t> group_of;
  for (const SweepSetting& setting : settings.settings) {
    const auto [at, is_new] = group_of.try_emplace(scene_key(setting.options), groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].push_back(&setting);
  }
  return Sweep(request, settings, busy, quiet).run(groups);
}

}  // namespace hybridrt::cli
