#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/loading_line.h"
#include "cli/progress.h"
#include "cli/render_output.h"
#include "cli/run_report.h"
#include "cli/standard_streams.h"
#include "cli/version.h"
#include "core/base/output_file.h"
#include "core/base/timing.h"
#include "core/image/contact_sheet.h"
#include "core/image_io/encode_image.h"
#include "core/mesh/topology_warnings.h"
#include "core/render/aov.h"
#include "core/render/file_sink.h"
#include "core/render/fingerprint.h"
#include "core/render/timings_csv.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

constexpr int kSheetColumns = 4, kSheetCell_px = 320, kMostSheetCells = 20;

/// What the user sees while frames are rendered: text, or one JSON object a line.
class Reporter {
 public:
  Reporter(const OutputOptions& options, int64_t frames)
      : json_(options.json), verbose_(options.verbose), progress_(frames, options.quiet || options.json) {}

  void warnings(const Warnings& all) {
    for (const std::string& warning : all)
      if (json_)
        emit({{"event", "warning"}, {"message", warning}});
      else
        progress_.say("hybridrt: warning: " + warning);
  }

  void start(const RenderOptions& render, const RenderJob& job, const RunFacts& facts) {
    const std::string renderer = facts.gl ? facts.gl->renderer : "no GL";
    if (json_)
      emit({{"event", "start"},
            {"scene", render.scene},
            {"triangles", job.scene.triangle_count()},
            {"frames", job.frames.count()},
            {"renderer", renderer}});
    else if (verbose_)
      progress_.say(fmt::format("{}: {} triangles, {}; {}, ready after {:.0f} ms", render.scene,
                                job.scene.triangle_count(), settings_line(job.settings), renderer, facts.ready_ms));
  }

  void frame(const Frame& frame, const fs::path& path) {
    progress_.frame_done();
    if (json_) {
      json timings;
      for (size_t i = 0; i < kPassNames.size() - 1; ++i)  // written later
        timings[std::string(kPassNames[i]) + "_ms"] = frame.timings.pass_ms[i];
      timings["wall_ms"] = frame.timings.wall_ms;
      emit({{"event", "frame"}, {"frame", frame.number}, {"path", path.string()}, {"timings", timings}});
    } else if (verbose_) {
      progress_.say(fmt::format("frame {}: {:.1f} ms -> {}", frame.number, frame.timings.wall_ms, path.string()));
    }
  }

  void end(const RunTotals& totals, bool stopped) {
    if (json_)
      emit({{"event", "end"},
            {"frames", totals.frames},
            {"stopped", stopped},
            {"frames_per_second", totals.frames_per_second()}});
  }

 private:
  static void emit(const json& event) {
    fmt::print("{}\n", event.dump(-1, ' ', false, json::error_handler_t::replace));
    flush_output();
  }
  const bool json_, verbose_;
  Progress progress_;
};

/// Small copies of evenly spaced frames for the contact sheet.
class SheetCollector {
 public:
  explicit SheetCollector(int64_t frames)
      : step_(std::max<int64_t>(1, (frames + kMostSheetCells - 1) / kMostSheetCells)) {}
  void add(const Image& picture) {
    if (seen_++ % step_ != 0) return;
    const int height = std::max(1, picture.height_px * kSheetCell_px / picture.width_px);
    cells_.push_back(box_filtered(picture, kSheetCell_px, height));
  }
  Image sheet() const { return contact_sheet(cells_, kSheetColumns, kSheetCell_px); }

 private:
  const int64_t step_;
  int64_t seen_ = 0;
  std::vector<Image> cells_;
};

ExitCode render(const RenderOptions& command_line, const OutputOptions& output) {
  catch_signals();
  Warnings warnings;
  RunTotals totals;
  const Stopwatch loading;
  const SceneSource source = parse_scene_source(command_line.scene);
  const RenderOptions options = with_scene_settings(command_line, source);
  const int threads = thread_count(options);
  gl::limit_software_threads(threads);  // before the first thread is started
  ThreadPool pool(threads);
  const RenderJob job = load_showing_progress(options, source, pool, warnings, output.quiet || output.json);
  topology_warnings(job.scene, job.topology, warnings);
  totals.load_ms = loading.elapsed_ms();
  FileClaims claims;
  const OutputPaths paths = prepare_output(output, options, job, claims, warnings);

  Reporter reporter(output, job.frames.count());
  reporter.warnings(warnings);
  const uint64_t scene_print = fingerprint(job.scene);
  SheetCollector sheet(job.frames.count());
  TimingsCsv timings(paths.timings);
  FileSink sink(encode_image_file, pool.size(), static_cast<size_t>(2 * pool.size()));

  const bool layered = keeps_layers(output_path(paths.pattern, job.frames.lowest()).string());
  Stopwatch rendering;
  const RunFacts facts = run(
      job, pool,
      [&](const RunFacts& so_far) {
        reporter.start(options, job, so_far);
        rendering.restart();
      },
      stop_requested,
      [&](Frame&& frame) {
        const int number = frame.number;
        const FrameRequest request = frame_request(job, number);
        const ImageMetadata metadata = {
            {"hybridrt", kVersion},
            {"settings", settings_line(job.settings)},
            {"fingerprint", fmt::format("{:016x}", fingerprint(scene_print, request, job.settings))}};
        const auto written = [&timings, number](double ms) { timings.file_written(number, ms); };
        const fs::path path = output_path(paths.pattern, number);
        totals.add(frame);
        timings.add(frame, static_cast<int>(layered ? 1 : 1 + frame.aovs.size()));
        if (!output.contact_sheet.empty()) sheet.add(frame.picture);
        reporter.frame(frame, path);
        if (layered)
          frame.picture.layers = std::move(frame.aovs);
        else
          for (const ImageLayer& aov : frame.aovs)
            sink.submit(output_path(paths.pattern, number, aov.name),
                        display_image(aov, frame.picture.width_px, frame.picture.height_px), written, metadata);
        sink.submit(path, std::move(frame.picture), written, metadata);
      });
  totals.rendering_ms = rendering.elapsed_ms();

  const Stopwatch draining;
  sink.drain();
  totals.drain_ms = draining.elapsed_ms();
  timings.finish();
  totals.sum[PassId::write] = timings.written_ms();
  if (!output.contact_sheet.empty() && totals.frames > 0) sink.submit(output.contact_sheet, sheet.sheet());
  sink.drain();
  write_file_atomically(paths.report, run_report(options, job, pool.size(), facts, totals, warnings)
                                              .dump(2, ' ', false, json::error_handler_t::replace) +
                                          "\n");

  reporter.end(totals, stop_requested());
  if (!output.json && !output.quiet && paths.timings != "-") {
    fmt::print("{}\nimages   {}\ntimings  {}\n", summary_table(job, totals),
               output_path(paths.pattern, job.frames.lowest()).string(), paths.timings);
    if (!output.contact_sheet.empty()) fmt::print("sheet    {}\n", output.contact_sheet);
  }
  return interrupted_or(ExitCode::ok);
}

}  // namespace

void add_render_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("render", "Render a frame or a sequence; write images and the timings CSV");
  auto options = std::make_shared<RenderOptions>();
  auto output = std::make_shared<OutputOptions>();
  add_render_options(*command, *options);

  const char* group = "Output";
  command->add_option("-o,--output", output->pattern, "Images, like out/name.####.png (default out/SCENENAME.####.png)")
      ->type_name("PATTERN")
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
  command->add_flag("--json", output->json, "One JSON object a line on standard output for every event")->group(group);
  command->add_flag("-q,--quiet", output->quiet, "Only errors and warnings")->group(group);
  command->add_flag("-v,--verbose", output->verbose, "A line for every frame")->group(group);

  command->callback([options, output, &chosen] { chosen = [options, output] { return render(*options, *output); }; });
}

}  // namespace hybridrt::cli
