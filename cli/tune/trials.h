#pragma once

#include <map>
#include <memory>

#include "cli/sweep/loaded_scene.h"
#include "cli/tune/goal.h"
#include "core/base/run_files.h"

namespace hybridrt::cli {

/// What tune chooses: render options by their names without dashes.
using Choice = std::map<std::string, std::string>;

/// "--method raster --shadows map".
std::string text_of(const Choice& choice);

struct Trial {
  Choice choice;
  double error = 0;              ///< of the worst frame, in the goal's unit
  std::vector<double> times_ms;  ///< of frames; empty: not measured

  double ms() const;  ///< their median; 0 if there are none
};

/// Renders choices on some frames of a scene, and remembers them.
class Trials {
 public:
  /// `base`: the command line; `truth_samples` of the reference.
  Trials(const RenderOptions& base, const Goal& goal, int truth_samples, bool quiet);

  /// From now on these frames are tried; what was found on others is forgotten.
  void set_frames(const std::vector<int>& frames);

  /// The worst error over the frames; rendered once for each choice.
  double error(const Choice& choice);
  /// The error of another frame.
  double error_at(const Choice& choice, int frame);
  /// Times choices in turns, so that a drift of the machine hits all alike.
  void measure(const std::vector<Choice>& choices);
  double ms(const Choice& choice) { return find(choice).ms(); }

  /// What was read.
  const RunFiles& files() const { return files_; }
  int truth_samples() const { return truth_samples_; }
  const std::vector<Trial>& all() const { return trials_; }

 private:
  Trial& find(const Choice& choice);
  void set_job_of(const Choice& choice, const std::vector<int>& frames);
  double worst_error();  ///< of the job

  const RenderOptions base_;
  const Goal goal_;
  const int truth_samples_;
  const bool quiet_;
  std::vector<int> frames_;
  std::shared_ptr<const SceneSource> source_;
  std::unique_ptr<ThreadPool> pool_;
  LoadedScene scene_;
  RunFiles files_;
  TruthStore truths_;
  std::vector<Trial> trials_;
};

}  // namespace hybridrt::cli
