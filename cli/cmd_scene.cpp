// hybridrt scene NAME -o FILE.obj: writes a procedural scene.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/core.h>
#include <memory>

#include "cli/commands.h"
#include "core/scene/obj_writer.h"
#include "core/scene/spheres.h"

namespace hybridrt::cli {
namespace {

struct SceneArguments {
  std::string name;
  SpheresOptions spheres;
  std::string output;
};

ExitCode write_scene(const SceneArguments& arguments) {
  const std::string output = arguments.output.empty() ? arguments.name + ".obj" : arguments.output;
  const SpheresPlan plan = plan_spheres(arguments.spheres);
  const WrittenObj written = write_obj(make_spheres(arguments.spheres), output);
  fmt::print("{}: {} triangles, {} balls, {} of them mirrors, {} bytes; materials in {}\n", output,
             plan.triangles(), plan.balls(), std::count(plan.is_mirror.begin(), plan.is_mirror.end(), 1),
             written.obj_bytes, written.mtl.string());
  return ExitCode::ok;
}

}  // namespace

void add_scene_command(CLI::App& app, Command& chosen) {
  CLI::App* scene = app.add_subcommand("scene", "write a procedural scene as OBJ and MTL");
  const auto arguments = std::make_shared<SceneArguments>();
  scene->add_option("NAME", arguments->name, "which one")->required()->check(CLI::IsMember({"spheres"}));
  scene
      ->add_option("--triangles", arguments->spheres.triangles,
                   fmt::format("how many in all, {} to {}, met within 2 %", SpheresOptions::kFewestTriangles,
                               SpheresOptions::kMostTriangles))
      ->capture_default_str();
  scene
      ->add_option("--reflective", arguments->spheres.reflective_percent,
                   "percent of the balls that are mirrors")
      ->capture_default_str();
  scene->add_option("-o,--output", arguments->output, "the .obj file (default: NAME.obj)");
  scene->callback([arguments, &chosen] { chosen = [arguments] { return write_scene(*arguments); }; });
}

}  // namespace hybridrt::cli
