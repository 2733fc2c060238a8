#include "cli/reporter.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/interrupt.h"
#include "cli/status_signal.h"
#include "cli/warning_output.h"
#include "core/base/error.h"
#include "core/base/output_file.h"

namespace hybridrt::cli {

using json = nlohmann::ordered_json;

namespace {

void emit(const json& event) {
  OutputFile file = OutputFile::standard_output();
  file.write(event.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
  file.commit();
}

}  // namespace

Reporter::Reporter(const OutputOptions& options, int64_t frames)
    : json_(options.json),
      quiet_(options.quiet),
      verbose_(options.verbose),
      frames_(frames),
      progress_(frames, options.quiet || options.json) {}

void Reporter::warnings(const Warnings& all) {
  for (const Warning& warning : all)
    if (json_) {
      json event = {{"event", "warning"}};
      event.update(json_of(warning));
      emit(event);
    } else {
      progress_.say(line_of(warning));
    }
}

void Reporter::notes(const std::vector<std::string>& all) {
  for (const std::string& note : all)
    if (json_)
      emit({{"event", "note"}, {"message", note}});
    else if (!quiet_)
      progress_.say("hybridrt: " + in_one_line(note));
}

void Reporter::start(const RenderOptions& options, const RenderJob& job, const RunFacts& facts) {
  const std::string renderer = facts.gl ? facts.gl->renderer : "no GL";
  if (json_)
    emit({{"event", "start"},
          {"scene", options.scene},
          {"triangles", job.scene.triangle_count()},
          {"frames", job.frames.count()},
          {"renderer", renderer}});
  else if (verbose_)
    progress_.say(fmt::format("{}: {} triangles, {}; {}, ready after {:.0f} ms", options.scene,
                              job.scene.triangle_count(), settings_line(job.settings), renderer, facts.ready_ms));
}

void Reporter::count() {
  progress_.frame_done();
  set_status("rendering", ++done_, frames_);
}

void Reporter::kept(int frame, const std::filesystem::path& path) {
  count();
  if (json_)
    emit({{"event", "kept"}, {"frame", frame}, {"path", path.string()}, {"done", done_}, {"of", frames_}});
  else if (verbose_)
    progress_.say(fmt::format("frame {}: kept {}", frame, path.string()));
}

void Reporter::frame(const Frame& frame, const std::filesystem::path& path) {
  count();
  if (json_) {
    json timings;
    for (size_t i = 0; i < kPassNames.size() - 1; ++i)  // the last, writing, comes later
      timings[std::string(kPassNames[i]) + "_ms"] = frame.timings.pass_ms[i];
    timings["wall_ms"] = frame.timings.wall_ms;
    emit({{"event", "frame"},
          {"frame", frame.number},
          {"path", path.string()},
          {"done", done_},
          {"of", frames_},
          {"timings", timings}});
  } else if (verbose_) {
    progress_.say(fmt::format("frame {}: {:.1f} ms -> {}", frame.number, frame.timings.wall_ms, path.string()));
  }
}

void Reporter::end(const RunTotals& totals, bool stopped) {
  if (json_)
    emit({{"event", "end"},
          {"frames", totals.frames},
          {"kept", totals.kept},
          {"stopped", stopped},
          {"state", stopped ? "stopped" : "done"},
          {"exit_code", static_cast<int>(interrupted_or(ExitCode::ok))},
          {"frames_per_second", totals.frames_per_second()},
          {"rendered_per_second", totals.rendered_per_second()},
          {"written_per_second", totals.written_per_second()}});
}

void report_failure(const Error& problem) {
  emit({{"event", "end"},
        {"state", "failed"},
        {"exit_code", static_cast<int>(exit_code_of(problem.kind()))},
        {"message", problem.what()}});
}

}  // namespace hybridrt::cli
