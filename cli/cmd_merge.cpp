#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/merge/joined.h"
#include "cli/merge/merged_report.h"
#include "cli/standard_streams.h"
#include "cli/table_names.h"
#include "cli/warning_output.h"
#include "core/base/file_claims.h"
#include "core/base/output_file.h"
#include "core/render/timings_csv.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::string folder;
  bool json = false, missing = false;
};

std::string text_of_frames(const std::vector<int>& frames) { return text_of(spec_of(frames)); }

bool is_complete(const Joined& joined) { return joined.missing.empty() && joined.makers.size() <= 1; }

/// One sentence: which frames are missing, which were made otherwise than most, what to do.
std::string complaint_about(const Joined& joined) {
  const FrameRange& whole = joined.sequence();
  const std::string sequence = fmt::format("{}-{}", whole.first, whole.last);
  std::string text = (joined.shards.front().folder / name_below(joined.shards.front().pattern)).string() + ": ";
  const auto render = [&](const std::vector<int>& frames) {
    return fmt::format("render --frames {} --sequence {} --resume", text_of_frames(frames), sequence);
  };
  if (!joined.missing.empty())
    text += fmt::format("{} of {} frames are missing: {} ({})", joined.missing.size(),
                        joined.missing.size() + joined.whose.size(), text_of_frames(joined.missing),
                        render(joined.missing));
  for (size_t i = 1; i < joined.makers.size(); ++i) {
    const auto& [maker, frames] = joined.makers[i];
    if (i > 1 || !joined.missing.empty()) text += "; ";
    text += fmt::format(
        "{} of {} frames were made otherwise than the rest: {} by {}, the rest by {} ({}, with --gl and --accel as the "
        "rest)",
        frames.size(), joined.whose.size(), text_of_frames(frames), maker, joined.makers.front().first, render(frames));
  }
  return text;
}

void claim(FileClaims& claims, const fs::path& file) {
  if (claims.claim(file) == FileClaims::Answer::taken)
    throw error(ErrorKind::output, "another run is writing {}; merge when it has ended", file.string());
}

/// Writes both tables of the whole.
TableNames write_tables(const Joined& joined, const fs::path& folder) {
  const TableNames names = table_names(folder, "", joined.shards.front().pattern);
  FileClaims claims;
  claim(claims, names.timings);
  claim(claims, names.report);
  claims.remove_stale_temporaries();
  require_writable(names.report);
  TimingsRows rows;
  for (const auto& [frame, shard] : joined.whose)
    if (const auto row = joined.shards[shard].rows.find(frame); row != joined.shards[shard].rows.end())
      rows.insert(*row);
  TimingsCsv timings(names.timings.string(), rows);
  for (const auto& [frame, shard] : joined.whose) timings.add_earlier(frame);
  timings.finish();
  write_file_atomically(names.report, merged_report(joined, names.timings.string()).dump(2) + "\n");
  return names;
}

void print_json(const Joined& joined, const TableNames& names) {
  nlohmann::ordered_json made_otherwise = nlohmann::ordered_json::array();
  for (size_t i = 1; i < joined.makers.size(); ++i)
    made_otherwise.push_back({{"frames", text_of_frames(joined.makers[i].second)}, {"by", joined.makers[i].first}});
  const nlohmann::ordered_json event = {
      {"pictures", (joined.shards.front().folder / name_below(joined.shards.front().pattern)).string()},
      {"sequence", {joined.sequence().first, joined.sequence().last}},
      {"runs", joined.shards.size()},
      {"frames", joined.whose.size()},
      {"missing", text_of_frames(joined.missing)},
      {"made_otherwise", made_otherwise},
      {"without_times", text_of_frames(joined.without_times)},
      {"timings", names.timings.string()},
      {"report", names.report.string()}};
  fmt::print("{}\n", event.dump());
}

void print_text(const Joined& joined, const TableNames& names) {
  const FrameRange& whole = joined.sequence();
  fmt::print("{} of {} frames of {}-{}, by {} run{}\ntimings  {}\nrun      {}\n", joined.whose.size(),
             joined.whose.size() + joined.missing.size(), whole.first, whole.last, joined.shards.size(),
             joined.shards.size() == 1 ? "" : "s", names.timings.string(), names.report.string());
}

/// Frames that are there, but were written by a run that was killed before it wrote their rows.
void warn_of_times(const Joined& joined, const TableNames& names) {
  if (joined.without_times.empty()) return;
  warn({WarningCode::times_missing,
        fmt::format("{} lacks the times of frames {}, whose runs were killed before they wrote them",
                    names.timings.string(), text_of_frames(joined.without_times))});
}

ExitCode merge(const MergeOptions& options) {
  std::vector<std::vector<Shard>> sequences = by_pictures(read_shards(options.folder));
  for (const std::vector<Shard>& shards : sequences) require_one_sequence(shards);
  if (options.missing && sequences.size() > 1)
    throw error(ErrorKind::usage, "{}: holds parts of {} sequences; --missing takes a folder of one", options.folder,
                sequences.size());
  ThreadPool pool(allowed_processors());
  bool complete = true;
  for (std::vector<Shard>& shards : sequences) {
    const Joined joined = join(std::move(shards), pool);
    complete = complete && is_complete(joined);
    if (options.missing) {
      if (!joined.missing.empty()) fmt::print("{}\n", text_of_frames(joined.missing));
      continue;
    }
    const TableNames names = write_tables(joined, options.folder);
    options.json ? print_json(joined, names) : print_text(joined, names);
    warn_of_times(joined, names);
    if (!is_complete(joined)) complain(complaint_about(joined));
  }
  return complete ? ExitCode::ok : ExitCode::some_failed;
}

}  // namespace

void add_merge_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "merge", "Join the tables of runs that rendered parts of a sequence; exit 1 when frames are missing");
  auto options = std::make_shared<MergeOptions>();
  command->add_option("DIR", options->folder, "The folder with the runs' tables (run.A-B.json)")->required();
  CLI::Option* json = command->add_flag("--json", options->json, "Print one JSON object for each sequence");
  command
      ->add_flag("--missing", options->missing,
                 "Write nothing; print the frames that are missing, as --frames takes them")
      ->excludes(json);
  command->footer(
      "Examples:\n"
      "  hybridrt render car.obj --frames 1-50 --sequence 1-100 -o out/car.####.png\n"
      "  hybridrt render car.obj --frames 51-100 --sequence 1-100 -o out/car.####.png\n"
      "  hybridrt merge out");
  command->callback([options, &chosen] { chosen = [options] { return merge(*options); }; });
}

}  // namespace hybridrt::cli
