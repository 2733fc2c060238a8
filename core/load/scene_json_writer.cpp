#include "core/load/scene_json_writer.h"

#include <nlohmann/json.hpp>

#include "core/base/output_file.h"
#include "core/base/shortest.h"

namespace hybridrt {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const dvec3& v) { return {v.x, v.y, v.z}; }

Json color(const vec3& c) { return {shortest_double(c.x), shortest_double(c.y), shortest_double(c.z)}; }

}  // namespace

void write_scene_json(const std::filesystem::path& path_json, const std::string& mesh, const SceneShot& shot) {
  Json json;
  json["meshes"] = {mesh};
  if (shot.camera) {
    const Camera& camera = *shot.camera;
    // To a millionth of a degree: 38 degrees converted to radians come back as 38.
    const double fov_y_deg = std::round(camera.fov_y_rad * 180 / kPi * 1e6) / 1e6;
    json["camera"] = {{"eye", numbers(camera.eye_world)},
                      {"target", numbers(camera.target_world)},
                      {"up", numbers(camera.up)},
                      {"fov_y_deg", fov_y_deg}};
  }
  if (shot.lights) {
    json["lights"] = Json::array();
    for (const DirectionalLight& light : *shot.lights) {
      Json entry = {{"type", "directional"}, {"toward", numbers(light.toward)}, {"color", color(light.color)}};
      if (!light.casts_shadow) entry["shadow"] = false;
      json["lights"].push_back(entry);
    }
  }
  if (shot.ambient) json["ambient"] = color(*shot.ambient);
  if (shot.background) json["background"] = color(*shot.background);
  write_file_atomically(path_json, std::string_view(json.dump(1) + "\n"));
}

}  // namespace hybridrt
