#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/files_read.h"
#include "cli/frame_warnings.h"
#include "cli/frame_writer.h"
#include "cli/interrupt.h"
#include "cli/loading_line.h"
#include "cli/option_values.h"
#include "cli/render_output.h"
#include "cli/reporter.h"
#include "cli/run_inputs.h"
#include "cli/run_report.h"
#include "cli/status_signal.h"
#include "core/base/output_file.h"
#include "core/base/timing.h"
#include "core/mesh/topology_warnings.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

void print_summary(const OutputOptions& output, const OutputPaths& paths, const RenderJob& job,
                   const RunTotals& totals) {
  if (output.json || output.quiet || paths.timings == "-" || paths.stream.name == "-") return;
  fmt::print("{}\nimages   {}\n", summary_table(job, totals),
             paths.stream.name.empty() ? output_path(paths.pattern, job.frames.lowest()).string() : paths.stream.name);
  if (!paths.timings.empty()) fmt::print("timings  {}\n", paths.timings);
  if (!output.contact_sheet.empty()) fmt::print("sheet    {}\n", output.contact_sheet);
}

/// Whether frames of the --sequence are left to other runs.
bool is_part(const RenderOptions& options, const FrameSpec& frames) {
  const std::optional<FrameRange>& whole = options.sequence;
  return whole && frames.count() < int64_t{whole->last} - whole->first + 1;
}

ExitCode render(const RenderOptions& given, const OutputOptions& asked, const std::vector<std::string>& command_line) {
  show_status_on_signal();
  set_status("loading the scene");
  Warnings warnings;
  RunTotals totals;
  const Stopwatch loading;
  const SceneSource source = scene_source_of(given);
  RenderOptions options = with_scene_settings(given, source);
  if (!asked.contact_sheet.empty())
    options.sheet_bytes =
        SheetCollector::most_bytes(finished_settings(options), parse_frame_spec(options.frames).count());
  const int threads = thread_count(options);
  gl::limit_software_threads(threads);  // before the first thread is started
  ThreadPool pool(threads);
  RenderJob job = load_showing_progress(options, source, pool, warnings, asked.quiet || asked.json);
  topology_warnings(job.scene, job.topology, warnings);
  totals.load_ms = loading.elapsed_ms();
  set_status("preparing the first frame");
  RunFiles files;
  add_files_read(options, source, files);
  add_files_read(job.scene, files);
  FileClaims claims;
  OutputOptions output = asked;
  output.is_part = is_part(options, job.frames);
  const OutputPaths paths = prepare_output(output, source, job, files, claims, warnings);

  Reporter reporter(output, job.frames.count());
  reporter.warnings(warnings);
  reporter.notes(job.scene.notes);
  FrameWriter writer(output, paths, job, threads);
  FrameWarningsGiven told;
  std::vector<int> there;
  job.wants = [&](int frame) {
    if (!writer.keeps(frame)) return true;
    ++totals.kept;
    there.push_back(frame);
    reporter.kept(frame, output_path(paths.pattern, frame));
    return false;
  };
  Stopwatch rendering;
  std::optional<FinishingFrames> finishing;
  const auto starting = [&](const RunFacts& so_far) {
    writer.start(so_far);
    finishing.emplace();
    reporter.start(options, job, so_far);
    set_status("rendering", totals.kept, job.frames.count());
    rendering.restart();
  };
  const auto deliver = [&](Frame&& frame) {
    totals.add(frame);
    there.push_back(frame.number);
    if (const auto warning = frame_warning(frame, job, told)) {
      reporter.warnings({*warning});
      warnings.push_back(*warning);
    }
    reporter.frame(frame,
                   paths.stream.name.empty() ? output_path(paths.pattern, frame.number) : fs::path(paths.stream.name));
    const Stopwatch waiting;
    writer.write(std::move(frame));
    totals.waited_ms += waiting.elapsed_ms();
  };
  const RunFacts facts = run(job, pool, starting, stop_requested, deliver);
  totals.rendering_ms = rendering.elapsed_ms();
  set_status("writing the last files", totals.frames + totals.kept, job.frames.count());
  writer.finish(totals);
  nlohmann::ordered_json report = run_report(options, job, threads, facts, totals, warnings);
  report.update(run_inputs(command_line, options, job, paths, there));
  if (!paths.report.empty())
    write_file_atomically(paths.report,
                          report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  reporter.end(totals, stop_requested());
  print_summary(output, paths, job, totals);
  return interrupted_or(ExitCode::ok);
}

/// With --json an error is an event too.
ExitCode render_and_report(const RenderOptions& options, const OutputOptions& output,
                           const std::vector<std::string>& command_line) {
  try {
    return render(options, output, command_line);
  } catch (const Error& problem) {
    const bool is_ours = output.pattern != "-" && output.timings != "-";  // standard output
    if (output.json && is_ours && problem.kind() != ErrorKind::output) report_failure(problem);
    throw;
  }
}

}  // namespace

void add_render_command(CLI::App& app, const std::vector<std::string>& command_line, Command& chosen) {
  CLI::App* command = app.add_subcommand("render", "Render a frame or a sequence; write images and the timings CSV");
  auto options = std::make_shared<RenderOptions>();
  auto output = std::make_shared<OutputOptions>();
  add_render_options(*command, *options);

  const char* group = "Output";
  command
      ->add_option("-o,--output", output->pattern,
                   "Images, like out/name.####.png (default out/SCENENAME.####.png); - is standard output")
      ->type_name("PATTERN")
      ->check([](const std::string& text) { return std::string(text.empty() ? "a name must not be empty" : ""); })
      ->group(group);
  command
      ->add_option("--timings", output->timings,
                   "CSV of each frame's pass times (default: beside the images; - is "
                   "standard output)")
      ->type_name("FILE")
      ->group(group);
  command->add_option("--contact-sheet", output->contact_sheet, "Also write one picture of up to 20 frames")
      ->type_name("FILE")
      ->group(group);
  command
      ->add_option_function<std::string>(
          "--existing",
          [output](const std::string& text) { output->existing = parse_name("--existing", kExisting, text); },
          "Pictures that are there: " + names_in(kExisting) +
              " (default overwrite). resume keeps those that this "
              "command would write again, byte for byte; refuse ends at the first")
      ->type_name("WHAT")
      ->group(group);
  command
      ->add_flag_callback(
          "--resume", [output] { output->existing = Existing::resume; }, "The same as --existing resume")
      ->group(group);
  command
      ->add_option_function<std::string>(
          "--compression",
          [output](const std::string& text) { output->compression = parse_name("--compression", kCompressions, text); },
          "How PNG and EXR files are packed: " + names_in(kCompressions) + " (default fast); the pixels are the same")
      ->type_name("HOW")
      ->group(group);
  command
      ->add_option_function<std::string>(
          "--exr", [output](const std::string& text) { output->exr = parse_name("--exr", kExrNumbers, text); },
          "The numbers of an EXR's picture: " + names_in(kExrNumbers) + " (default float)")
      ->type_name("NUMBERS")
      ->group(group);
  command
      ->add_option_function<std::string>(
          "--pipe", [output](const std::string& text) { output->video = parse_name("--pipe", kVideoFormats, text); },
          "What -o - carries: " + names_in(kVideoFormats) + " (default y4m for several frames, PNG for one)")
      ->type_name("FORMAT")
      ->group(group);
  command
      ->add_option_function<std::string>(
          "--fps", [output](const std::string& text) { output->rate = parse_frame_rate("--fps", text); },
          "Frames per second that y4m tells its reader, like 30 or 30000/1001 (default 25)")
      ->type_name("RATE")
      ->group(group);
  command->add_flag("--json", output->json, "One JSON object a line on standard output for every event")->group(group);
  command->add_flag("-q,--quiet", output->quiet, "Only errors and warnings")->group(group);
  command->add_flag("-v,--verbose", output->verbose, "A line for every frame")->group(group);

  command->footer(
      "Examples:\n"
      "  hybridrt render scene:chess --size 1920x1080 --samples 8\n"
      "  hybridrt render car.obj --frames 1000 -o turn/car.####.png --resume\n"
      "  hybridrt render hall.json --camera walk.json --frames 1-240:10 --contact-sheet walk.png");
  command->callback([options, output, command_line, &chosen] {
    chosen = [=] { return render_and_report(*options, *output, command_line); };
  });
}

}  // namespace hybridrt::cli
