// hybridrt scene NAME -o FILE.obj: writes a procedural scene.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/core.h>
#include <memory>

#include "cli/commands.h"
#include "core/base/run_files.h"
#include "core/load/obj_writer.h"
#include "core/load/scene_json_writer.h"
#include "core/load/scene_source.h"

namespace hybridrt::cli {
namespace {

struct SceneArguments {
  std::string name, triangles, reflective, output;
};

ExitCode write_scene(const SceneArguments& arguments) {
  std::string argument = "scene:" + arguments.name;
  if (!arguments.triangles.empty()) argument += ",triangles=" + arguments.triangles;
  if (!arguments.reflective.empty()) argument += ",reflective=" + arguments.reflective;
  const SceneSource source = parse_scene_source(argument);
  const ProceduralScene& procedural = *source.procedural;
  const std::filesystem::path output = arguments.output.empty() ? short_name(source) + ".obj" : arguments.output;
  const std::filesystem::path json = std::filesystem::path(output).replace_extension(".json");
  RunFiles files;
  files.writes(output, "-o");
  files.writes(std::filesystem::path(output).replace_extension(".mtl"), "the materials as");
  files.writes(json, "camera and lights as");
  const Scene scene = procedural.make(source.procedural_values);
  const WrittenObj written = write_obj(scene, output);
  write_scene_json(json, output.filename().string(), procedural.shot(source.procedural_values));
  const auto reflects = [&](uint32_t material) { return scene.materials[material].reflective(); };
  fmt::print("{}: {} triangles ({} of them reflect), {} bytes; materials in {}, camera and lights in {}\n",
             output.string(), scene.triangle_count(),
             std::count_if(scene.triangle_materials.begin(), scene.triangle_materials.end(), reflects),
             written.obj_bytes, written.mtl.string(), json.string());
  return ExitCode::ok;
}

/// What scenes there are, and their parameters, a line each.
std::string about_scenes() {
  std::string text = "Scenes, and the KEYs that each takes:\n";
  for (const ProceduralScene& scene : procedural_scenes()) {
    text += fmt::format("  {}: {}\n", scene.name, scene.about);
    for (const SceneParameter& p : scene.parameters)
      text += fmt::format("    {}: {} ({:.15g} to {:.15g}{})\n", p.name, p.about, p.least, p.most,
                          p.standard ? fmt::format(", default {:.15g}", *p.standard) : ", or as designed");
  }
  return text;
}

}  // namespace

void add_scene_command(CLI::App& app, Command& chosen) {
  CLI::App* scene = app.add_subcommand("scene", "Write a procedural scene as OBJ, MTL and scene JSON");
  const auto arguments = std::make_shared<SceneArguments>();
  scene->add_option("NAME", arguments->name, "Which one, and what it should be like")
      ->required()
      ->type_name("SCENE[,KEY=VALUE]");
  scene->add_option("--triangles", arguments->triangles, "The same as NAME,triangles=N")->type_name("N");
  scene->add_option("--reflective", arguments->reflective, "The same as NAME,reflective=PERCENT")->type_name("PERCENT");
  scene->add_option("-o,--output", arguments->output, "The .obj file (default: NAME.obj); the others beside it");
  scene->footer(about_scenes() +
                "\nExamples:\n"
                "  hybridrt scene chess\n"
                "  hybridrt scene spheres,triangles=500k,reflective=10 -o balls.obj");
  scene->callback([arguments, &chosen] { chosen = [arguments] { return write_scene(*arguments); }; });
}

}  // namespace hybridrt::cli
