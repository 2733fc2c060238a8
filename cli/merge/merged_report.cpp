#include "cli/merge/merged_report.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <string_view>

#include "core/render/frame_columns.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What a single run would have been called by: the shard's words, all frames, nothing kept.
Json whole_command(const Json& words, const FrameRange& sequence) {
  Json whole = Json::array();
  for (size_t i = 0; i < words.size(); ++i) {
    const auto word = words[i].get<std::string>();
    const std::string name = word.substr(0, word.find('='));
    if (word == "--resume") continue;
    if (name == "--frames" || name == "--sequence" || name == "--existing") {
      if (name == word) ++i;  // its value follows
      continue;
    }
    whole.push_back(word);
  }
  whole.push_back("--frames");
  whole.push_back(fmt::format("{}-{}", sequence.first, sequence.last));
  return whole;
}

double wall_ms_in(const std::string& row, size_t column) {
  std::string_view rest = row;
  for (; column > 0; --column) rest.remove_prefix(std::min(rest.find(','), rest.size() - 1) + 1);
  double ms = 0;
  std::from_chars(rest.data(), rest.data() + rest.size(), ms);
  return ms;
}

double frames_per_second(const Joined& joined) {
  const std::vector<std::string> names = frame_columns();
  const auto column = static_cast<size_t>(std::find(names.begin(), names.end(), "wall_ms") - names.begin()) + 1;
  double wall_ms = 0;
  size_t frames = 0;
  for (const auto& [frame, shard] : joined.whose) {
    const auto row = joined.shards[shard].rows.find(frame);
    if (row == joined.shards[shard].rows.end()) continue;
    wall_ms += wall_ms_in(row->second, column);
    ++frames;
  }
  return wall_ms > 0 ? static_cast<double>(frames) / (wall_ms * 1e-3) : 0;
}

const Shard& shard_of_last_frame(const Joined& joined) {
  const auto last = [](const Shard& shard) {
    return shard.fingerprints.empty() ? -1 : shard.fingerprints.rbegin()->first;
  };
  return *std::max_element(joined.shards.begin(), joined.shards.end(),
                           [&](const Shard& a, const Shard& b) { return last(a) < last(b); });
}

/// What a run says about itself and its machine.
Json facts_of(const Shard& shard) {
  Json facts = {{"file", shard.file.filename().string()}};
  for (const char* field :
       {"commit", "command_line", "folder", "date", "gl", "passes", "processor", "threads", "load_ms", "accel_build_ms",
        "ready_ms", "rendering_ms", "waited_ms", "drain_ms", "write_ms", "frames", "kept_frames", "peak_memory_mib"})
    facts[field] = shard.report.at(field);
  return facts;
}

}  // namespace

Json merged_report(const Joined& joined, const std::string& timings) {
  const FrameRange& sequence = joined.sequence();
  Json report = joined.shards.front().report;
  report["settings"]["frames"] = fmt::format("{}-{}", sequence.first, sequence.last);
  report["warnings"] = Json::array();
  report["date"] = "";
  const char* const sums[] = {"load_ms",   "accel_build_ms", "ready_ms", "rendering_ms",
                              "waited_ms", "drain_ms",       "write_ms", "repeated_frames"};
  for (const char* field : sums) report[field] = Json(0);
  Json shards = Json::array();
  for (const Shard& shard : joined.shards) {
    for (const char* field : sums) {
      const Json &sum = report[field], &value = shard.report.at(field);
      report[field] = sum.is_number_integer() && value.is_number_integer()
                          ? Json(sum.get<int64_t>() + value.get<int64_t>())
                          : Json(sum.get<double>() + value.get<double>());
    }
    report["peak_memory_mib"] =
        std::max(report["peak_memory_mib"].get<double>(), shard.report.at("peak_memory_mib").get<double>());
    report["date"] = std::max(report["date"].get<std::string>(), shard.date);
    for (const Json& warning : shard.report.at("warnings"))
      if (std::find(report["warnings"].begin(), report["warnings"].end(), warning) == report["warnings"].end())
        report["warnings"].push_back(warning);
    shards.push_back(facts_of(shard));
  }
  const Json& camera = shard_of_last_frame(joined).report.at("camera");
  if (camera.contains("last")) report["camera"]["last"] = camera["last"];
  report["frames"] = joined.whose.size();
  report["kept_frames"] = 0;
  report["frames_per_second"] = frames_per_second(joined);
  const auto per_second = [&](double ms) {
    return ms > 0 ? static_cast<double>(joined.whose.size()) / (ms * 1e-3) : 0;
  };
  const double rendering_ms = report["rendering_ms"];
  report["rendered_per_second"] = per_second(rendering_ms - report["waited_ms"].get<double>());
  report["written_per_second"] = per_second(rendering_ms + report["drain_ms"].get<double>());
  report["command_line"] = whole_command(report.at("command_line"), sequence);
  report["outputs"]["timings"] =
      (fs::path(report["outputs"]["timings"].get<std::string>()).parent_path() / fs::path(timings).filename()).string();
  report["outputs"]["part"] = nullptr;
  report["fingerprints"] = Json::object();
  for (const auto& [frame, shard] : joined.whose)
    report["fingerprints"][std::to_string(frame)] = joined.shards[shard].fingerprints.at(frame);
  report["missing"] = joined.missing.empty() ? Json(nullptr) : Json(text_of(spec_of(joined.missing)));
  report["shards"] = std::move(shards);
  return report;
}

}  // namespace hybridrt::cli
