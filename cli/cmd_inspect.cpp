#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/inspection.h"
#include "cli/loading_line.h"
#include "core/mesh/topology_warnings.h"

namespace hybridrt::cli {
namespace {

ExitCode inspect(RenderOptions command_line, bool as_json) {
  command_line.probes = nullptr;
  const SceneSource source = scene_source_of(command_line);
  const RenderOptions options = with_scene_settings(command_line, source);
  ThreadPool pool(thread_count(options));
  Inspection found;
  found.scene = source.argument;
  found.job = load_showing_progress(options, source, pool, found.warnings, as_json);
  const RenderJob& job = found.job;
  topology_warnings(job.scene, job.topology, found.warnings);
  found.material_triangles.resize(job.scene.materials.size());
  for (uint32_t material : job.scene.triangle_materials) ++found.material_triangles[material];

  const int first = *FrameCursor(job.frames).next();
  found.plan = make_frame_plan(job.scene, job.facts, frame_request(job, first), job.settings);
  const bool moves = lights_move(job.lights, job.motion);
  found.steps = explain_plan(found.plan, job.facts, job.settings, moves);
  found.memory = estimate_memory(job.scene, job.facts, job.topology, job.sheets, job.settings, job.lights.lights.size(),
                                 moves, pool.size(), job.frames.count());

  using Handler = nlohmann::ordered_json::error_handler_t;
  fmt::print("{}",
             as_json ? inspection_json(found).dump(2, ' ', false, Handler::replace) + "\n" : inspection_text(found));
  return ExitCode::ok;
}

}  // namespace

void add_inspect_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "inspect", "Say what was loaded, repaired or left out, and what a frame will run; needs no GL");
  auto options = std::make_shared<RenderOptions>();
  auto as_json = std::make_shared<bool>(false);
  add_render_options(*command, *options);
  command->add_flag("--json", *as_json, "As one JSON object");
  command->footer(
      "Examples:\n"
      "  hybridrt inspect car.obj\n"
      "  hybridrt inspect scene.json --shadows blur --json");
  command->callback(
      [options, as_json, &chosen] { chosen = [options, as_json] { return inspect(*options, *as_json); }; });
}

}  // namespace hybridrt::cli
