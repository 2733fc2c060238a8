#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/inspection.h"
#include "cli/loading_line.h"
#include "core/mesh/topology_warnings.h"

namespace hybridrt::cli {
namespace {

ExitCode inspect(const RenderOptions& options, bool as_json) {
  Inspection found;
  found.scene = options.scene;
  found.job = load_showing_progress(options, found.warnings, as_json);
  const RenderJob& job = found.job;

  ThreadPool pool(job.threads);
  found.topology = build_topology(job.scene, pool);
  topology_warnings(job.scene, found.topology, found.warnings);
  found.material_triangles.resize(job.scene.materials.size());
  for (uint32_t material : job.scene.triangle_materials) ++found.material_triangles[material];

  const SceneFacts facts = make_scene_facts(job.scene);
  const int first = *FrameCursor(job.frames).next();
  found.plan = make_frame_plan(job.scene, facts, frame_request(job, first), job.settings);
  const bool moves = lights_move(job.lights, job.motion);
  found.steps = explain_plan(found.plan, facts, job.settings, job.accel, moves);
  found.memory = estimate_memory(job.scene, facts, job.settings, job.accel, job.lights.lights.size(), moves,
                                 job.threads, job.frames.count());

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
  command->callback(
      [options, as_json, &chosen] { chosen = [options, as_json] { return inspect(*options, *as_json); }; });
}

}  // namespace hybridrt::cli
