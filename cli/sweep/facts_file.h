#pragma once

#include <nlohmann/json.hpp>

#include "cli/sweep/facts.h"

namespace hybridrt::cli {

/// sweep.json of a sweep under way.
class FactsFile {
 public:
  /// Takes over what an earlier run of the same sweep knows. Throws as require_same_sweep().
  FactsFile(const SweepRequest& request, const SweepSettings& settings, double busy);

  void set_pictures(int setting, const SettingPictures& pictures);
  void set_gl_renderer(const std::string& renderer) { facts_["gl_renderer"] = renderer; }

  /// Throws Error(output).
  void write() const;

 private:
  const std::filesystem::path path_;
  nlohmann::ordered_json facts_;
};

}  // namespace hybridrt::cli
