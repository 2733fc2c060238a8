// hybridrt scene NAME -o FILE.obj: writes a procedural scene.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/core.h>
#include <memory>

#include "cli/commands.h"
#include "core/base/run_files.h"
#include "core/load/obj_writer.h"
#include "core/load/scene_json_writer.h"
#include "core/procedural/procedural.h"

namespace hybridrt::cli {
namespace {

struct SceneArguments {
  std::string name;
  ProceduralOptions options;
  std::string output;
};

ExitCode write_scene(const SceneArguments& arguments) {
  const std::filesystem::path output = arguments.output.empty() ? arguments.name + ".obj" : arguments.output;
  const ProceduralScene& procedural = *find_procedural(arguments.name);
  const std::filesystem::path json = std::filesystem::path(output).replace_extension(".json");
  RunFiles files;
  files.writes(output, "-o");
  files.writes(std::filesystem::path(output).replace_extension(".mtl"), "the materials as");
  files.writes(json, "camera and lights as");
  const Scene scene = procedural.make(arguments.options);
  const WrittenObj written = write_obj(scene, output);
  write_scene_json(json, output.filename().string(), procedural.shot());
  const auto reflects = [&](uint32_t material) { return scene.materials[material].reflective(); };
  fmt::print("{}: {} triangles ({} of them reflect), {} bytes; materials in {}, camera and lights in {}\n",
             output.string(), scene.triangle_count(),
             std::count_if(scene.triangle_materials.begin(), scene.triangle_materials.end(), reflects),
             written.obj_bytes, written.mtl.string(), json.string());
  return ExitCode::ok;
}

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const ProceduralScene& scene : procedural_scenes()) names.emplace_back(scene.name);
  return names;
}

std::string about_triangles() {
  std::string text = "Total number, met within 5 % (";
  for (const ProceduralScene& s : procedural_scenes())
    text += fmt::format("{}{}: {} to {}, default {}", &s == procedural_scenes().data() ? "" : "; ", s.name,
                        s.fewest_triangles, s.most_triangles, s.default_triangles);
  return text + ")";
}

}  // namespace

void add_scene_command(CLI::App& app, Command& chosen) {
  CLI::App* scene = app.add_subcommand("scene", "Write a procedural scene as OBJ, MTL and scene JSON");
  const auto arguments = std::make_shared<SceneArguments>();
  scene->add_option("NAME", arguments->name, "Which one")
      ->required()
      ->type_name("SCENE")
      ->check(CLI::IsMember(names()));
  scene->add_option("--triangles", arguments->options.triangles, about_triangles());
  scene->add_option("--reflective", arguments->options.reflective_percent,
                    "Percent of the connected components that are mirrors, all else opaque and matt (spheres: 10 % "
                    "of the balls; chess and thin without it: as designed)");
  scene->add_option("-o,--output", arguments->output, "The .obj file (default: NAME.obj); the others beside it");
  scene->footer(
      "Examples:\n"
      "  hybridrt scene chess\n"
      "  hybridrt scene spheres --triangles 500000 --reflective 10 -o balls.obj");
  scene->callback([arguments, &chosen] { chosen = [arguments] { return write_scene(*arguments); }; });
}

}  // namespace hybridrt::cli
