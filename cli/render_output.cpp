#include "cli/render_output.h"

#include <fmt/format.h>
#include <unistd.h>

#include "cli/table_names.h"
#include "core/base/error.h"
#include "core/base/given_descriptor.h"
#include "core/base/output_file.h"
#include "core/image_io/encode_image.h"
#include "core/render/output_claims.h"
#include "core/render/picture_files.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;
using Answer = FileClaims::Answer;

/// Sets timings and report; with `as_part` they carry the frames.
void name_tables(const OutputOptions& options, const RenderJob& job, bool as_part, OutputPaths& paths) {
  const std::string part = as_part ? name_part_of(job.frames) : "";
  const fs::path folder = common_folder(paths.pattern);
  // The report lies beside the CSV, but not in /dev.
  const std::string& timings = options.timings;
  const bool is_file = !timings.empty() && timings != "-" && !descriptor_named_by(timings) &&
                       (!fs::exists(timings) || fs::is_regular_file(timings));
  const TableNames names = table_names(is_file ? fs::path(timings).parent_path() : folder, part, paths.pattern);
  paths.timings = timings.empty() ? names.timings.string() : timings;
  paths.report = names.report;
  paths.part = options.is_part ? part : "";
}

bool is_taken(FileClaims& claims, const fs::path& file) { return file != "-" && claims.claim(file) == Answer::taken; }

void require_free(bool taken, const fs::path& file) {
  if (taken)
    throw error(ErrorKind::output,
                "another run is writing {}; wait for it, write elsewhere, or give each run its own "
                "--frames",
                file.string());
}

/// The AOVs that become files of their own: not the layers of an EXR.
std::vector<std::string_view> aov_files(const RenderJob& job, const OutputPattern& pattern) {
  const bool layered = keeps_layers(output_path(pattern, job.frames.lowest()).string());
  return layered ? std::vector<std::string_view>() : aov_names(job.settings.aovs);
}

/// The tables and the contact sheet beside what is read and beside each other.
void add_tables(const OutputOptions& options, const OutputPaths& paths, RunFiles& files) {
  if (!options.contact_sheet.empty()) files.writes(options.contact_sheet, "--contact-sheet");
  if (!paths.timings.empty() && paths.timings != "-") files.writes(paths.timings, "--timings");
  if (!paths.report.empty()) files.writes(paths.report, "run.json as");
}

void claim_all(const OutputOptions& options, const RenderJob& job, OutputPaths& paths, FileClaims& claims,
               Warnings& warnings) {
  const fs::path pictures = common_folder(paths.pattern) / name_below(paths.pattern);
  const Answer answer = claim_frames(claims, paths.pattern, job.frames, aov_files(job, paths.pattern));
  require_free(answer == Answer::taken, pictures);
  if (answer == Answer::unknown)
    warnings.emplace_back(WarningCode::file_locks_missing,
                          fmt::format("{} is on a file system without locks: another run that writes the same files "
                                      "would not be noticed",
                                      common_folder(paths.pattern).string()));
  if (!options.contact_sheet.empty()) require_free(is_taken(claims, options.contact_sheet), options.contact_sheet);
  if (!options.timings.empty()) require_free(is_taken(claims, options.timings), options.timings);

  if (!options.is_part && (is_taken(claims, paths.timings) || is_taken(claims, paths.report))) {
    const std::string usual = paths.report.string();
    name_tables(options, job, true, paths);
    warnings.emplace_back(WarningCode::tables_renamed,
                          fmt::format("another run is writing {} or its timings; those of this run go to {}{}", usual,
                                      paths.report.string(), options.timings.empty() ? " and " + paths.timings : ""));
  }
  require_free(is_taken(claims, paths.timings), paths.timings);
  require_free(is_taken(claims, paths.report), paths.report);
}

void require_files_apart(const OutputOptions& options, const RenderJob& job, const OutputPaths& paths, RunFiles files) {
  add_tables(options, paths, files);
  require_pictures_unused(files, paths.pattern, job.frames, aov_files(job, paths.pattern));
}

bool is_device(const std::string& name) {
  std::error_code missing;
  return fs::is_character_file(name, missing);
}

/// Whether pictures go to something that is no file and whose name says no format: "-", /dev/fd/3, /dev/null, a pipe.
bool is_stream(const std::string& name) {
  std::error_code missing;
  if (name == "-" || descriptor_named_by(name)) return true;
  return fs::is_other(fs::status(name, missing)) && !can_write_format(name);
}

/// Several frames are a video: a reader could not tell PNGs apart that follow one another. A device keeps nothing, and
/// takes what files would hold.
StreamTarget stream_target(const OutputOptions& options, const RenderJob& job) {
  StreamTarget target{options.pattern, options.video, options.rate.value_or(FrameRate())};
  if (!target.video && job.frames.count() > 1 && !is_device(options.pattern)) target.video = VideoFormat::y4m;
  if (target.video && job.settings.alpha)
    throw error(ErrorKind::usage, "-o {}: {} has no alpha channel; leave --alpha out, or write files like x.####.png",
                options.pattern, name_in(kVideoFormats, *target.video));
  if (options.rate && target.video != VideoFormat::y4m)
    throw error(ErrorKind::usage, "--fps is told by y4m alone, and -o {} is {} here; leave it out", options.pattern,
                target.video ? "rgb24" : "a PNG");
  return target;
}

/// Options that would have no effect on files.
void require_options_of_files(const OutputOptions& options, const fs::path& first) {
  if (options.video || options.rate)
    throw error(ErrorKind::usage, "{} is for pipes, and {} is a file; give -o -, or leave it out",
                options.video ? "--pipe" : "--fps", first.string());
  if (options.exr && !keeps_layers(first.string()))
    throw error(ErrorKind::usage, "--exr {}: {} is no EXR file; write one, or leave it out",
                name_in(kExrNumbers, *options.exr), first.string());
}

/// Nothing else may go to standard output then.
OutputPaths pictures_to_stream(const OutputOptions& options, const RenderJob& job, RunFiles& files,
                               FileClaims& claims) {
  const bool standard_output = options.pattern == "-";
  if (standard_output && (options.json || options.timings == "-"))
    throw error(ErrorKind::usage, "-o - wants standard output for the pictures; give {} too, or leave it out",
                options.json ? "--json a picture file" : "--timings a file");
  if (job.settings.aovs != 0)
    throw error(ErrorKind::usage, "-o {} takes no --aov; write files like x.####.png", options.pattern);
  OutputPaths paths;
  paths.stream = stream_target(options, job);
  paths.timings = options.timings;
  if (!options.contact_sheet.empty()) require_writable_format(options.contact_sheet);
  add_tables(options, paths, files);
  for (const std::string& file : {options.timings, options.contact_sheet}) {
    if (file.empty()) continue;
    require_free(is_taken(claims, file), file);
    require_writable(file);
  }
  return paths;
}

/// Throws Error(usage) naming the first picture or AOV that is there.
void require_none_there(const RenderJob& job, const OutputPattern& pattern) {
  const std::vector<std::string_view> aovs = aov_files(job, pattern);
  const auto require_absent = [](const fs::path& file) {
    std::error_code unreachable;
    if (fs::exists(file, unreachable))
      throw error(ErrorKind::usage,
                  "--existing refuse: {} is there; write elsewhere, remove it, or take --existing overwrite or resume",
                  file.string());
  };
  FrameCursor cursor(job.frames);
  while (const std::optional<int> frame = cursor.next()) {
    require_absent(output_path(pattern, *frame));
    for (const std::string_view aov : aovs) require_absent(output_path(pattern, *frame, aov));
  }
}

}  // namespace

OutputPaths prepare_output(const OutputOptions& given, const SceneSource& source, const RenderJob& job, RunFiles& files,
                           FileClaims& claims, Warnings& warnings) {
  OutputOptions options = given;
  if (descriptor_named_by(options.timings) == STDOUT_FILENO) options.timings = "-";
  if (options.json && options.timings == "-")
    throw error(ErrorKind::usage, "--timings - and --json both want standard output; give --timings a file");
  if (descriptor_named_by(options.pattern) == STDOUT_FILENO) options.pattern = "-";
  if (is_stream(options.pattern)) {
    if (options.existing != Existing::overwrite)
      throw error(ErrorKind::usage, "-o {} is no file that could be there already; leave --existing out",
                  options.pattern);
    return pictures_to_stream(options, job, files, claims);
  }
  OutputPaths paths;
  const std::string usual = "out/" + short_name(source) + ".####.png";
  paths.pattern = parse_output_pattern(options.pattern.empty() ? usual : options.pattern, job.frames.count() > 1);
  const fs::path first = output_path(paths.pattern, job.frames.lowest());
  require_writable_format(first);
  require_options_of_files(options, first);
  const PixelRect picture = picture_rect(job.settings);
  require_writable_size(first, picture.width_px, picture.height_px);
  if (job.settings.alpha && !keeps_alpha(first.string()))
    throw error(ErrorKind::usage, "{}: this format has no alpha channel; with --alpha use .png, .exr or .tif",
                first.string());
  if (!options.contact_sheet.empty()) require_writable_format(options.contact_sheet);

  name_tables(options, job, options.is_part, paths);
  require_files_apart(options, job, paths, files);
  if (options.existing == Existing::refuse) require_none_there(job, paths.pattern);
  claim_all(options, job, paths, claims, warnings);
  add_tables(options, paths, files);
  claims.remove_stale_temporaries();
  require_writable(first);
  require_writable(paths.report);
  if (!options.contact_sheet.empty()) require_writable(options.contact_sheet);
  return paths;
}

}  // namespace hybridrt::cli
