#pragma once

#include <string>
#include <vector>

#include "core/base/named.h"

namespace hybridrt::cli {

enum class Preset { paper, pareto, scaling, growth, pixels, stability };
inline constexpr Named<Preset> kPresets[] = {{"paper", Preset::paper},     {"pareto", Preset::pareto},
                                             {"scaling", Preset::scaling}, {"growth", Preset::growth},
                                             {"pixels", Preset::pixels},   {"stability", Preset::stability}};

/// A chart that people want, as the options of a sweep. What the command line says itself takes precedence.
struct PresetOptions {
  std::vector<std::string> over;                             ///< values of --over
  std::vector<std::pair<std::string, std::string>> options;  ///< render options: name with dashes, value
  int truth_samples = 1;
  bool memory = false;
};

/// Throws Error(usage) for a preset that `scene` does not take. Preset::stability adds nothing: it is a run of its own.
PresetOptions preset_options(Preset preset, const std::string& scene, int processors);

}  // namespace hybridrt::cli
