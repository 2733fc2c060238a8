// Scene JSON without its meshes, and the camera in it or in a file beside it.

#include <stdexcept>

#include "core/load/scene_file.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/reader.h"

namespace hybridrt::fuzz {

void read_input(std::string_view bytes) {
  input_file("path.json", R"({"orbit": {"target": [0, 0, 0], "radius": 3}})");
  const std::filesystem::path file = input_file("input.json", bytes);
  const SceneSource scene = read_scene_file(file);
  if (scene.lights)
    for (const DirectionalLight& light : *scene.lights)
      if (!(std::abs(glm::length(light.toward) - 1) < 1e-9)) throw std::logic_error("a light's direction is not unit");
  Warnings warnings;
  scene_file_camera(scene, UpAxis::y, warnings);
}

}  // namespace hybridrt::fuzz
