#include "cli/sweep/facts_file.h"

#include <fstream>

#include "cli/sweep/accuracy.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/output_file.h"

namespace hybridrt::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Null if there is no such file.
Json read_facts(const std::filesystem::path& path) {
  require_regular_file(path);
  std::ifstream file(path);
  if (!file) return nullptr;
  Json facts = Json::parse(file, nullptr, /*allow_exceptions=*/false);
  if (facts.is_discarded())
    throw error(ErrorKind::input, "{}: is no JSON; restore it, or choose another folder for -o", path.string());
  return facts;
}

}  // namespace

FactsFile::FactsFile(const SweepRequest& request, const SweepSettings& settings, double busy)
    : path_(request.facts()), facts_(sweep_facts(request, settings, busy)) {
  const Json earlier = read_facts(path_);
  if (earlier.is_null()) {
    if (std::filesystem::exists(request.rows()))
      throw error(ErrorKind::input, "{}: there is no {} beside it; choose another folder for -o, or remove it",
                  request.rows().string(), path_.filename().string());
    return;
  }
  require_same_sweep(request, earlier);
  for (const char* key : {"gl_renderer", "settings"})
    if (earlier.contains(key)) facts_[key] = earlier[key];
}

void FactsFile::set_pictures(int setting, const SettingPictures& pictures) {
  const auto file_or_null = [](const std::string& file) { return file.empty() ? Json(nullptr) : Json(file); };
  Json& entry = facts_["settings"][static_cast<size_t>(setting - 1)];
  entry["picture"] = file_or_null(pictures.picture);
  entry["difference"] = file_or_null(pictures.difference);
  entry["truth"] = file_or_null(pictures.truth);
}

void FactsFile::write() const {
  write_file_atomically(path_, facts_.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace hybridrt::cli
