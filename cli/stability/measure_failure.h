#pragma once

#include <map>
#include <memory>

#include "cli/stability/failure_sweep.h"
#include "cli/sweep/accuracy.h"

namespace hybridrt::cli {

/// How far a contender is from the truth at one value: of its worst frame.
struct FailurePoint {
  size_t pixels = 0;      ///< that the sweep's measure looks at
  size_t pixels_bad = 0;  ///< of them
  Accuracy accuracy;

  double percent_bad() const {
    return pixels_bad == 0 ? 0
                           : 100 * static_cast<double>(pixels_bad) / static_cast<double>(std::max<size_t>(pixels, 1));
  }
};

/// What is looked at where a contender fails: linear.
struct FailurePictures {
  Image picture, truth, difference;
};

/// A signal asked to stop.
struct Stopped {};

/// Renders a failure sweep's contenders. Scenes are made anew for each value, points are remembered. Its functions
/// throw Stopped, and what make_render_job() throws.
class FailureMeasurer {
 public:
  FailureMeasurer(const FailureSweep& sweep, const RenderOptions& base, ThreadPool& pool);

  const FailurePoint& point(const Contender& contender, double value);
  FailurePictures pictures(const Contender& contender, double value);

  /// By contender's name and value.
  const std::map<std::pair<std::string, double>, FailurePoint>& points() const { return points_; }

 private:
  void set_job_of(const Contender& contender, double value);
  const std::vector<Truth>& truths_of(const Contender& contender, double value);

  const FailureSweep& sweep_;
  const RenderOptions& base_;
  ThreadPool& pool_;
  std::shared_ptr<const SceneSource> source_;
  std::unique_ptr<LoadedScene> scene_;
  std::string scene_key_;
  std::map<double, std::vector<Truth>> truths_;  ///< by value
  std::map<std::pair<std::string, double>, FailurePoint> points_;
};

}  // namespace hybridrt::cli
