#include "cli/stability/measure_failure.h"

#include "core/base/interrupt.h"
#include "core/image/srgb.h"

namespace hybridrt::cli {
namespace {

void stop_if_asked() {
  if (stop_requested()) throw Stopped();
}

size_t pixels_in_shadow(const Truth& truth) {
  size_t count = 0;
  for (size_t i = 0; i < truth.ids.size(); ++i) count += truth.ids[i] != kNoTriangle && truth.shadow[i] < 1;
  return count;
}

FailurePoint point_of(Measure measure, const Frame& frame, const Truth& truth, const Frame* before,
                      const Truth* truth_before) {
  FailurePoint point;
  point.accuracy = measure_accuracy(frame, truth);
  switch (measure) {
    case Measure::off:
      point.pixels = frame.picture.pixel_count();
      point.pixels_bad = point.accuracy.pixels_off;
      break;
    case Measure::shadows:
      point.pixels = pixels_in_shadow(truth);
      point.pixels_bad = point.accuracy.false_lit.value_or(0) + point.accuracy.false_shadow.value_or(0);
      break;
    case Measure::flicker:
      if (!before) break;
      const Flicker flicker = count_flicker(frame, *before, truth, *truth_before);
      point.pixels = flicker.true_changes;
      point.pixels_bad = flicker.false_changes;
      break;
  }
  return point;
}

}  // namespace

FailureMeasurer::FailureMeasurer(const FailureSweep& sweep, const RenderOptions& base, ThreadPool& pool)
    : sweep_(sweep), base_(base), pool_(pool) {}

void FailureMeasurer::set_job_of(const Contender& contender, double value) {
  SweepSetting setting;
  setting.options = options_of(base_, sweep_, value, contender);
  Warnings of_odd_scenes;
  if (!scene_ || scene_key_ != setting.options.scene) {
    source_ = std::make_shared<const SceneSource>(parse_scene_source(setting.options.scene));
    setting.source = source_;
    scene_.reset();
    scene_ = std::make_unique<LoadedScene>(load_scene_of(setting, pool_, of_odd_scenes));
    scene_key_ = setting.options.scene;
  }
  setting.source = source_;
  set_job(*scene_, setting, pool_, of_odd_scenes);
}

const std::vector<Truth>& FailureMeasurer::truths_of(const Contender& contender, double value) {
  if (sweep_.same_truth) value = sweep_.values.front();
  if (const auto known = truths_.find(value); known != truths_.end()) return known->second;
  set_job_of(contender, value);
  TruthStore store({1, {}}, {}, [](const std::string&) {});
  std::vector<Truth> truths = store.of(scene_->job, pool_);
  stop_if_asked();
  return truths_[value] = std::move(truths);
}

const FailurePoint& FailureMeasurer::point(const Contender& contender, double value) {
  const auto [at, is_new] = points_.try_emplace({contender.name, value});
  if (!is_new) return at->second;
  const std::vector<Truth>& truths = truths_of(contender, value);
  set_job_of(contender, value);
  const std::vector<Frame> frames = render_to_compare(scene_->job, pool_);
  stop_if_asked();
  FailurePoint& worst = at->second;
  for (size_t i = 0; i < frames.size(); ++i) {
    const FailurePoint point = point_of(sweep_.measure, frames[i], truths[i], i > 0 ? &frames[i - 1] : nullptr,
                                        i > 0 ? &truths[i - 1] : nullptr);
    const bool is_worse = std::pair(point.accuracy.non_finite, point.percent_bad()) >
                          std::pair(worst.accuracy.non_finite, worst.percent_bad());
    if (i == 0 || is_worse) worst = point;
  }
  return worst;
}

FailurePictures FailureMeasurer::pictures(const Contender& contender, double value) {
  const Truth& truth = truths_of(contender, value).back();
  set_job_of(contender, value);
  const std::vector<Frame> frames = render_to_compare(scene_->job, pool_);
  stop_if_asked();
  return {frames.back().picture, linear_from_srgb(truth.picture), amplified_difference(frames.back(), truth)};
}

}  // namespace hybridrt::cli
