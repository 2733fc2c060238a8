#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/sweep/axes.h"
#include "cli/sweep/truth.h"

namespace hybridrt::cli {

/// What a sweep was asked for, beside its settings.
struct SweepRequest {
  std::vector<std::string> command_line;
  RenderOptions base;
  std::vector<Axis> axes;
  std::string preset;  ///< empty: none
  int rounds = 3;
  bool memory = false;  ///< peaks of memory are measured, so scenes are not held beside one another
  TruthOptions truth;
  std::filesystem::path folder;

  std::filesystem::path rows() const { return folder / "sweep.csv"; }
  std::filesystem::path facts() const { return folder / "sweep.json"; }
  std::filesystem::path pictures() const { return folder / "pictures"; }
};

/// What became of a setting, for the report: files relative to the folder, empty where there are none.
struct SettingPictures {
  std::string picture, difference, truth;
};

/// The content of sweep.json before anything is rendered: what is measured, where and with what. `busy`: the share of
/// the processors that others used.
nlohmann::ordered_json sweep_facts(const SweepRequest& request, const SweepSettings& settings, double busy);

/// Throws Error(input) if the folder holds a sweep whose rows cannot be joined with this one's: another program,
/// machine, scene, options or axes. More rounds are welcome.
void require_same_sweep(const SweepRequest& request, const nlohmann::ordered_json& facts);

}  // namespace hybridrt::cli
