// hybridrt simplify: no more triangles than the frames need.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/loading_line.h"
#include "cli/simplify/drop_unseen.h"
#include "cli/simplify/path_bounds.h"
#include "cli/simplify/simplify_output.h"
#include "cli/simplify/simplify_report.h"
#include "cli/standard_streams.h"
#include "cli/warning_output.h"
#include "core/load/mtl_writer.h"
#include "core/load/obj_writer.h"
#include "core/load/text_scan.h"

namespace hybridrt::cli {
namespace {

struct SimplifyOptions {
  RenderOptions render;
  std::string max_error, output;
  bool drop_unseen = false, json = false, quiet = false;

  bool talks() const { return !json && !quiet; }
};

constexpr double kMostError_px = 1000;

double parse_max_error(const std::string& text) {
  if (text.ends_with("px"))
    if (const auto number = parse_number(std::string_view(text).substr(0, text.size() - 2));
        number && *number > 0 && *number <= kMostError_px)
      return *number;
  throw error(ErrorKind::usage, "--max-error {}: write 0.5px, a number above 0 and up to {} of pixels", text,
              kMostError_px);
}

/// The same scene and frames are needed before and after, and what is written is the scene itself.
void refuse_what_is_not_the_scene(const RenderOptions& options) {
  if (options.ground) throw error(ErrorKind::usage, "--ground is not part of the scene; leave it out");
  if (options.reflection_percent)
    throw error(ErrorKind::usage, "--reflection-percent changes the scene's materials; leave it out");
}

/// A job that renders the frames of `job` with another scene.
RenderJob job_with(const RenderJob& job, Scene scene, ThreadPool& pool, Warnings& warnings) {
  RenderJob other;
  other.settings = job.settings;
  other.frames = job.frames;
  other.motion = job.motion;
  other.lights = job.lights;
  other.most_bytes = job.most_bytes;
  other.gl = job.gl;
  other.shaders = job.shaders;
  other.repeats_still_frames = job.repeats_still_frames;
  set_scene(other, std::move(scene), pool, warnings);
  return other;
}

/// The options with the scene that they name, ready to work on.
struct LoadedJob {
  SceneSource source;
  RenderOptions render;  ///< with the scene's settings
  std::unique_ptr<ThreadPool> pool;
  RenderJob job;
};

void tell(Warnings& warnings) {
  for (const Warning& warning : warnings) warn(warning);
  warnings.clear();
}

LoadedJob load(const SimplifyOptions& options) {
  LoadedJob loaded;
  loaded.source = scene_source_of(options.render);
  loaded.render = with_scene_settings(options.render, loaded.source);
  refuse_what_is_not_the_scene(loaded.render);
  const int threads = thread_count(loaded.render);
  gl::limit_software_threads(threads);
  loaded.pool = std::make_unique<ThreadPool>(threads);
  Warnings warnings;
  loaded.job = load_showing_progress(loaded.render, loaded.source, *loaded.pool, warnings, !options.talks());
  tell(warnings);
  require_room_to_simplify(loaded.job, loaded.source);
  return loaded;
}

/// The job with what is left of its scene; fills in the report. Nothing if a signal asked to stop.
std::optional<RenderJob> lean_job(const RenderJob& job, const SimplifyOptions& options, ThreadPool& pool,
                                  SimplifyReport& report) {
  const std::vector<float> bounds = bounds_on_path(job, report.max_error_px, pool);
  if (stop_requested()) return std::nullopt;
  Simplified lean = simplify(job.scene, build_topology(job.scene, pool), bounds, pool, stop_requested);
  if (stop_requested()) return std::nullopt;
  const auto [least, largest] = std::minmax_element(bounds.begin(), bounds.end());
  report.least_bound = *least, report.largest_bound = *largest;
  report.triangles_before = job.scene.triangle_count();
  report.triangles_after = lean.scene.triangle_count();
  report.distance = std::move(lean.distance);
  report.rounds = lean.rounds;

  Warnings warnings;
  RenderJob after = job_with(job, std::move(lean.scene), pool, warnings);
  if (options.drop_unseen) {
    if (options.talks()) say("hybridrt: looking for what no frame sees\n");
    after = job_with(job, without_unseen(after, pool), pool, warnings);
    if (stop_requested()) return std::nullopt;
    report.triangles_unseen = report.triangles_after - after.scene.triangle_count();
    report.triangles_after = after.scene.triangle_count();
  }
  tell(warnings);
  return after;
}

void write(const LoadedJob& loaded, const Scene& scene, const SimplifyOutput& output, SimplifyReport& report) {
  Warnings warnings;
  const UpAxis up = loaded.render.up_axis.value_or(loaded.source.up_axis.value_or(UpAxis::y));
  const WrittenObj written = write_obj(scene, output.obj, up);
  warn_of_lost_materials(scene.materials, written.mtl, warnings);
  warn_of_what_is_not_geometry(loaded.source, output.obj, warnings);
  report.output = output.obj.string(), report.materials = written.mtl.string();
  report.bytes_after = written.obj_bytes + written.mtl_bytes;
  tell(warnings);
}

ExitCode simplify_scene(const SimplifyOptions& options) {
  catch_signals();
  SimplifyReport report;
  report.max_error_px = parse_max_error(options.max_error);
  LoadedJob loaded = load(options);
  RenderJob& job = loaded.job;
  report.scene = loaded.source.argument;
  report.bytes_before = bytes_of_files(job.scene);
  const SimplifyOutput output = prepare_simplify_output(options.output, loaded.source, job.scene);

  if (options.talks()) say(fmt::format("hybridrt: simplifying {} triangles\n", job.scene.triangle_count()));
  std::optional<RenderJob> after = lean_job(job, options, *loaded.pool, report);
  if (!after) return interrupted_or(ExitCode::ok);
  write(loaded, after->scene, output, report);
  if (options.talks()) say(fmt::format("hybridrt: rendering {} frames before and after\n", job.frames.count()));
  report.frames = compare_frames(job, *after, *loaded.pool);

  using Handler = nlohmann::ordered_json::error_handler_t;  // file names need not be UTF-8
  fmt::print("{}",
             options.json ? report_json(report).dump(2, ' ', false, Handler::replace) + "\n" : report_text(report));
  return interrupted_or(ExitCode::ok);
}

}  // namespace

void add_simplify_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("simplify", "Leave out triangles that the frames do not need");
  auto options = std::make_shared<SimplifyOptions>();
  add_render_options(*command, options->render);
  const char* group = "Simplify";
  command
      ->add_option("--max-error", options->max_error,
                   "0.5px: how far surfaces and their shadows may move in any frame, in pixels")
      ->type_name("E")
      ->required()
      ->group(group);
  command->add_option("-o,--output", options->output, "The .obj file; its .mtl beside it")
      ->type_name("FILE")
      ->required()
      ->group(group);
  command
      ->add_flag("--drop-unseen", options->drop_unseen,
                 "Also leave out what no frame sees, directly, in a mirror or by its shadow, at eight samples a pixel "
                 "or more")
      ->group(group);
  command->add_flag("--json", options->json, "Print one JSON object instead of the text")->group(group);
  command->add_flag("-q,--quiet", options->quiet, "Only errors and warnings")->group(group);
  command->footer(
      "Examples:\n"
      "  hybridrt simplify scan.ply --max-error 0.5px --frames 100 --size 1280x720 -o lean.obj\n"
      "  hybridrt simplify house.obj --camera walk.json --frames 500 --max-error 1px --json -o lean/house.obj");
  command->callback([options, &chosen] { chosen = [options] { return simplify_scene(*options); }; });
}

}  // namespace hybridrt::cli
