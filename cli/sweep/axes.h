#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/render_option_table.h"

namespace hybridrt::cli {

/// One dimension of a sweep: a render option, the scene, or a parameter of a procedural scene.
struct Axis {
  std::string name;                 ///< "blur-kernel"
  std::vector<std::string> values;  ///< as the option takes them; at least one
  Affects affects = Affects::quality;
  bool is_parameter = false;  ///< of the procedural scene

  std::string column() const;  ///< "blur_kernel"
};

/// `AXIS=VALUES`: values between commas, or between semicolons where they hold commas themselves; A:B and A:B:STEP are
/// numbers from A to B, A:B:*F multiplies by F. Throws Error(usage) for what is no axis, naming those that are, and for
/// values that cannot be read.
Axis parse_axis(const std::string& text, const std::string& scene);

/// One combination of values.
struct SweepSetting {
  int number = 1;                   ///< from 1, in the order of the product
  std::string label;                ///< "method=raster shadows=map": the axes with several values
  std::vector<std::string> values;  ///< one per axis
  RenderOptions options;            ///< complete: with_scene_settings() is applied
  std::shared_ptr<const SceneSource> source;
};

struct SweepSettings {
  std::vector<SweepSetting> settings;
  std::vector<std::string> left_out;  ///< the labels of combinations that `render` refuses
};

/// Every combination of the axes' values over the options of the command line, the last axis fastest, without those
/// that `render` refuses. Throws its Error(usage) if nothing is left, and as parse_scene_source().
SweepSettings make_sweep_settings(const RenderOptions& base, const std::vector<Axis>& axes);

}  // namespace hybridrt::cli
