#include "cli/merge/shard.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/render/timings_csv.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr size_t kMostReportBytes = size_t{1} << 30;

/// `run.PART.json` and `STEM.run.PART.json`.
bool is_part_name(const std::string& name) {
  const size_t run = name.starts_with("run.") ? 0 : name.rfind(".run.");
  const size_t part = run == 0 ? 4 : run + 5;
  return run != name.npos && name.ends_with(".json") && part + 5 < name.size() && std::isdigit(name[part]);
}

/// Where the pictures are now: as far from the tables as they were when these were written.
fs::path picture_folder(const fs::path& tables, const OutputPattern& pattern, const std::string& timings) {
  const fs::path apart = common_folder(pattern).lexically_proximate(fs::path(timings).parent_path());
  return (tables / apart).lexically_normal();
}

/// What is joined or told of each run.
constexpr const char* kNeeded[] = {"commit",          "command_line", "folder",         "gl",          "passes",
                                   "processor",       "threads",      "load_ms",        "ready_ms",    "accel_build_ms",
                                   "rendering_ms",    "drain_ms",     "frames",         "kept_frames", "warnings",
                                   "repeated_frames", "camera",       "peak_memory_mib"};

Shard shard_of(const fs::path& file, Json report) {
  for (const char* field : kNeeded) static_cast<void>(report.at(field));
  Shard shard;
  const Json& outputs = report.at("outputs");
  const auto timings = outputs.at("timings").get<std::string>();
  shard.file = file;
  shard.pattern = parse_output_pattern(outputs.at("pattern").get<std::string>(), /*several_frames=*/false);
  shard.folder = picture_folder(file.parent_path(), shard.pattern, timings);
  shard.date = report.at("date").get<std::string>();
  shard.sequence = {report.at("settings").at("sequence").at(0).get<int>(),
                    report.at("settings").at("sequence").at(1).get<int>(), 1};
  for (const auto& [frame, fingerprint] : report.at("fingerprints").items()) {
    int number = -1;
    std::from_chars(frame.data(), frame.data() + frame.size(), number);
    if (number < shard.sequence.first || number > shard.sequence.last)
      throw error(ErrorKind::input, "{}: frame {} is not of its sequence {}-{}; render that part again", file.string(),
                  frame, shard.sequence.first, shard.sequence.last);
    shard.fingerprints[number] = fingerprint.get<std::string>();
  }
  shard.rows = read_timings_rows((file.parent_path() / fs::path(timings).filename()).string()).value_or(TimingsRows());
  shard.report = std::move(report);
  return shard;
}

/// Nothing for a run of a whole sequence.
std::optional<Shard> read_shard(const fs::path& file) {
  try {
    Json report = Json::parse(read_whole_file(file, kMostReportBytes));
    if (report.at("outputs").at("part").is_null()) return std::nullopt;
    return shard_of(file, std::move(report));
  } catch (const Json::exception&) {
    throw error(
        ErrorKind::input,
        "{}: not a run file that this version of 'hybridrt render' writes; render that part again, or remove it",
        file.string());
  }
}

/// What two runs differ in that parts of one sequence share; empty if in nothing.
std::string difference_of(const Json& a, const Json& b) {
  const Json &of_a = a.at("settings"), &of_b = b.at("settings");
  for (const auto& [name, value] : of_a.items())
    if (name != "frames" && name != "frames_in_flight" && of_b.value(name, Json()) != value)
      return fmt::format("settings: {} is {} and {}", name, value.dump(), of_b.value(name, Json()).dump());
  if (a.at("scene_fingerprint") != b.at("scene_fingerprint"))
    return fmt::format("scenes ({} and {})", a.at("scene").at("source").dump(), b.at("scene").at("source").dump());
  if (a.at("version") != b.at("version"))
    return fmt::format("versions of hybridrt ({} and {})", a.at("version").dump(), b.at("version").dump());
  if (a.at("sequence_fingerprint") != b.at("sequence_fingerprint")) return "cameras, lights or backgrounds";
  return "";
}

}  // namespace

std::vector<Shard> read_shards(const fs::path& folder) {
  std::error_code problem;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder, problem); !problem && entry != fs::directory_iterator();
       entry.increment(problem))
    if (is_part_name(entry->path().filename().string())) files.push_back(entry->path());
  if (problem)
    throw error(ErrorKind::input, "{}: cannot be read: {}; name the folder of the runs' tables", folder.string(),
                problem.message());
  std::sort(files.begin(), files.end());
  std::vector<Shard> shards;
  for (const fs::path& file : files)
    if (std::optional<Shard> shard = read_shard(file)) shards.push_back(std::move(*shard));
  if (shards.empty())
    throw error(ErrorKind::input,
                "{}: holds no run.A-B.json of a part of a sequence; 'hybridrt render --frames A-B --sequence 1-N' "
                "writes them",
                folder.string());
  return shards;
}

std::vector<std::vector<Shard>> by_pictures(std::vector<Shard> shards) {
  std::map<std::string, std::vector<Shard>> sorted;
  for (Shard& shard : shards) sorted[name_below(shard.pattern)].push_back(std::move(shard));
  std::vector<std::vector<Shard>> sequences;
  for (auto& [name, of_one] : sorted) sequences.push_back(std::move(of_one));
  return sequences;
}

void require_one_sequence(const std::vector<Shard>& shards) {
  const Shard& first = shards.front();
  for (const Shard& other : shards)
    if (const std::string difference = difference_of(first.report, other.report); !difference.empty())
      throw error(ErrorKind::input,
                  "{} and {} are not parts of one sequence, but of different {}; render one of them again, or remove "
                  "the one that is out of date",
                  first.file.string(), other.file.string(), difference);
}

}  // namespace hybridrt::cli
