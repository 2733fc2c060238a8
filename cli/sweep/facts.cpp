#include "cli/sweep/facts.h"

#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/run_report.h"
#include "cli/sweep/accuracy.h"
#include "cli/version.h"
#include "core/base/error.h"

namespace hybridrt::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Pictures of a folder are the truth of all settings: scenes are then alternatives, as lean and full models are.
Json axes_json(const std::vector<Axis>& axes, const TruthOptions& truth) {
  Json all = Json::array();
  for (const Axis& axis : axes)
    all.push_back({{"name", axis.name},
                   {"column", axis.column()},
                   {"values", axis.values},
                   {"changes_truth", truth.folder.empty() && axis.affects != Affects::quality}});
  return all;
}

Json truth_json(const TruthOptions& truth) {
  const bool given = !truth.folder.empty();
  const char* kind = given ? "folder" : truth.samples > 0 ? "reference" : "none";
  const std::string note = given ? "the pictures in " + truth.folder.string() : "";
  return {{"method", given ? "" : "reference"}, {"samples", truth.samples}, {"kind", kind}, {"note", note}};
}

Json settings_json(const SweepSettings& settings) {
  Json all = Json::array();
  for (const SweepSetting& setting : settings.settings)
    all.push_back({{"number", setting.number},
                   {"label", setting.label},
                   {"picture", nullptr},
                   {"difference", nullptr},
                   {"amplification", kDifferenceAmplification},
                   {"truth", nullptr}});
  return all;
}

/// What must be equal for rows to stand in one table.
Json what_decides(const SweepRequest& request) {
  Json options = Json::array();
  for (const auto& [name, value] : request.base.given) options.push_back(name + " " + value);
  return {{"version", kVersion},
          {"commit", kCommit},
          {"processor", processor_name()},
          {"scene", request.base.scene},
          {"options", options},
          {"frames", request.base.frames},
          {"axes", axes_json(request.axes, request.truth)},
          {"truth", truth_json(request.truth)}};
}

}  // namespace

Json sweep_facts(const SweepRequest& request, const SweepSettings& settings, double busy) {
  Json facts = what_decides(request);
  facts["compiler"] = kCompiler;
  facts["command_line"] = request.command_line;
  facts["date"] = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  facts["threads"] = allowed_processors();
  facts["gl_renderer"] = nullptr;
  facts["busy"] = busy;
  facts["rounds"] = request.rounds;
  facts["preset"] = request.preset.empty() ? Json(nullptr) : Json(request.preset);
  facts["left_out"] = settings.left_out;
  facts["settings"] = settings_json(settings);
  return facts;
}

void require_same_sweep(const SweepRequest& request, const Json& facts) {
  const Json decides = what_decides(request);
  for (const auto& [key, value] : decides.items())
    if (!facts.is_object() || !facts.contains(key) || facts[key] != value)
      throw error(ErrorKind::input,
                  "{}: holds a sweep with another {}; choose another folder for -o, or remove that one",
                  request.folder.string(), key);
}

}  // namespace hybridrt::cli
