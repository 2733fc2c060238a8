#pragma once

#include <string>
#include <vector>

#include "cli/render_options.h"
#include "cli/stability/threshold.h"

namespace hybridrt::cli {

/// Render options: names without dashes, values.
using OptionValues = std::vector<std::pair<std::string, std::string>>;

/// A method with its shadows, as it stands in tables.
struct Contender {
  std::string name;  ///< "hybrid exact"
  OptionValues options;
};

/// What counts as bad, as a share of what.
enum class Measure {
  off,      ///< pixels off by more than 2/255 in a channel, of all
  shadows,  ///< pixels whose shadow is wrong, of those in shadow
  flicker,  ///< pixels that change by more than 2/255 more, or less, than the truth does, of those that change there
};
inline constexpr Named<Measure> kMeasures[] = {
    {"off", Measure::off}, {"shadows", Measure::shadows}, {"flicker", Measure::flicker}};

/// A made scene, and a number that drives it from where all is well to where methods fail.
struct FailureSweep {
  std::string name;            ///< of files: "light-horizon"
  std::string title;           ///< "The light sinks to the horizon"
  std::string reason;          ///< why methods fail there
  std::string scene;           ///< "stage", with parameters that stay
  std::string parameter;       ///< of the scene, or a render option without dashes
  std::string unit;            ///< of its values; may be empty
  std::vector<double> values;  ///< from harmless to severe
  Between between = Between::ratios;
  std::vector<Contender> contenders;
  OptionValues options = {};  ///< of all contenders
  bool same_truth = false;    ///< nothing should change: all are held against the truth of the first value
  Measure measure = Measure::off;

  bool parameter_is_option() const;
};

/// All of them, or those of a scene ("scene:wires"). Throws Error(usage) for a scene that none has.
std::vector<FailureSweep> failure_sweeps(const std::string& scene = "");

/// The command line with what is tried. `value` as text, "1e-06".
RenderOptions options_of(const RenderOptions& base, const FailureSweep& sweep, double value,
                         const Contender& contender);

/// Throws Error(usage) for an option of the command line that these sweeps set themselves.
void require_free_options(const RenderOptions& base);

}  // namespace hybridrt::cli
