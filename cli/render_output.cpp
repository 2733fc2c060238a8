#include "cli/render_output.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/image_io/encode_image.h"
#include "core/render/output_claims.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;
using Answer = FileClaims::Answer;

bool is_whole(const RenderJob& job) {
  const FrameRange& whole = job.motion.sequence;
  return job.frames.lowest() == whole.first && job.frames.highest() == whole.last;
}

/// Sets timings and report: `timings.csv`, or `timings.0001-0010.csv` with `range`.
void name_tables(const OutputOptions& options, const RenderJob& job, bool range, OutputPaths& paths) {
  const std::string part =
      range ? fmt::format(".{:04}-{:04}", job.frames.lowest(), job.frames.highest()) : std::string();
  const fs::path folder = common_folder(paths.pattern);
  paths.timings = options.timings.empty() ? (folder / ("timings" + part + ".csv")).string() : options.timings;
  // Beside the CSV, but not in /dev.
  const bool is_file = paths.timings != "-" && (!fs::exists(paths.timings) || fs::is_regular_file(paths.timings));
  paths.report = (is_file ? fs::path(paths.timings).parent_path() : folder) / ("run" + part + ".json");
}

bool is_taken(FileClaims& claims, const fs::path& file) { return file != "-" && claims.claim(file) == Answer::taken; }

void require_free(bool taken, const fs::path& file) {
  if (taken)
    throw error(ErrorKind::output,
                "another run is writing {}; wait for it, write elsewhere, or give each run its own "
                "--frames",
                file.string());
}

void claim_all(const OutputOptions& options, const RenderJob& job, OutputPaths& paths, FileClaims& claims,
               Warnings& warnings) {
  const fs::path pictures = common_folder(paths.pattern) / name_below(paths.pattern);
  const Answer answer = claim_frames(claims, paths.pattern, job.frames);
  require_free(answer == Answer::taken, pictures);
  if (answer == Answer::unknown)
    warnings.push_back(
        fmt::format("{} is on a file system without locks: another run that writes the same files "
                    "would not be noticed",
                    common_folder(paths.pattern).string()));
  if (!options.contact_sheet.empty()) require_free(is_taken(claims, options.contact_sheet), options.contact_sheet);
  if (!options.timings.empty()) require_free(is_taken(claims, options.timings), options.timings);

  if (is_whole(job) && (is_taken(claims, paths.timings) || is_taken(claims, paths.report))) {
    const std::string usual = paths.report.string();
    name_tables(options, job, true, paths);
    warnings.push_back(fmt::format("another run is writing {} or its timings; those of this run go to {}{}", usual,
                                   paths.report.string(), options.timings.empty() ? " and " + paths.timings : ""));
  }
  require_free(is_taken(claims, paths.timings), paths.timings);
  require_free(is_taken(claims, paths.report), paths.report);
}

}  // namespace

OutputPaths prepare_output(const OutputOptions& options, const SceneSource& source, const RenderJob& job,
                           FileClaims& claims, Warnings& warnings) {
  if (options.json && options.timings == "-")
    throw error(ErrorKind::usage, "--timings - and --json both want standard output; give --timings a file");
  OutputPaths paths;
  const std::string usual = "out/" + short_name(source) + ".####.png";
  paths.pattern = parse_output_pattern(options.pattern.empty() ? usual : options.pattern, job.frames.count() > 1);
  const fs::path first = output_path(paths.pattern, job.frames.lowest());
  require_writable_format(first);
  if (job.settings.alpha && !keeps_alpha(first.string()))
    throw error(ErrorKind::usage, "{}: this format has no alpha channel; with --alpha use .png, .exr or .tif",
                first.string());
  if (!options.contact_sheet.empty()) require_writable_format(options.contact_sheet);

  name_tables(options, job, !is_whole(job), paths);
  claim_all(options, job, paths, claims, warnings);
  require_writable(first);
  require_writable(paths.report);
  if (!options.contact_sheet.empty()) require_writable(options.contact_sheet);
  return paths;
}

}  // namespace hybridrt::cli
