#include "core/load/scene_file.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/camera_json.h"
#include "core/load/json_read.h"
#include "core/load/mesh_format.h"
#include "core/load/text_scan.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

void require_known_keys(const JsonPlace& scene) {
  scene.only(
      {"meshes", "up_axis", "camera", "camera_path", "lights", "ambient", "background", "glass", "opaque", "settings"});
}

fs::path beside(const fs::path& file, const std::string& name) {
  return (file.parent_path() / fs::path(name)).lexically_normal();
}

std::vector<fs::path> parse_meshes(const JsonPlace& place, const fs::path& file) {
  std::vector<fs::path> meshes;
  for (size_t i = 0; i < place.size(); ++i) {
    const std::string name = place[i].text();
    meshes.push_back(beside(file, name));
    if (!is_mesh_file(meshes.back())) place[i].fail(fmt::format("{} is not an {} file", in_quotes(name), kMeshFormats));
  }
  if (meshes.empty()) place.fail("there are no meshes; give at least one");
  return meshes;
}

UpAxis parse_up_axis(const JsonPlace& place) {
  const std::string name = place.text();
  const std::optional<UpAxis> axis = value_in(kUpAxes, name);
  if (!axis) place.fail(fmt::format("{} is not known; one of {}", in_quotes(name), names_in(kUpAxes)));
  return *axis;
}

std::vector<std::string> parse_names(const JsonPlace& place) {
  std::vector<std::string> names;
  for (size_t i = 0; i < place.size(); ++i) names.push_back(place[i].text());
  return names;
}

MaterialKinds parse_kinds(const JsonPlace& scene) {
  MaterialKinds kinds;
  kinds.where = scene.where();
  if (const auto glass = scene.find("glass")) kinds.glass = parse_names(*glass);
  if (const auto opaque = scene.find("opaque")) kinds.opaque = parse_names(*opaque);
  for (size_t i = 0; i < kinds.opaque.size(); ++i)
    if (std::find(kinds.glass.begin(), kinds.glass.end(), kinds.opaque[i]) != kinds.glass.end())
      scene.at("opaque")[i].fail(fmt::format("{} is among 'glass' too; give one", in_quotes(kinds.opaque[i])));
  return kinds;
}

/// A linear colour: three numbers, or one for three equal ones.
vec3 parse_color(const JsonPlace& place) {
  const dvec3 color = place.value().is_number() ? dvec3(place.number()) : place.vector();
  for (int i = 0; i < 3; ++i)
    if (!(color[i] >= 0 && color[i] <= 1e6)) place.fail("a colour's parts are 0 to 1000000");
  return vec3(color);
}

std::vector<DirectionalLight> parse_lights(const JsonPlace& place) {
  std::vector<DirectionalLight> lights;
  if (place.size() > HRT_MAX_LIGHTS)
    place.fail(fmt::format("there are {} lights; at most {} are possible", place.size(), HRT_MAX_LIGHTS));
  for (size_t i = 0; i < place.size(); ++i) {
    const JsonPlace entry = place[i];
    // First, since other types have other keys.
    const JsonPlace type = entry.at("type");
    if (const std::string name = type.text(); name != "directional")
      type.fail(name == "point" || name == "spot" || name == "environment"
                    ? fmt::format("type '{}' is not supported yet; directional lights are", name)
                    : fmt::format("{} is not known; write 'directional'", in_quotes(name)));
    entry.only({"type", "toward", "color", "shadow"});
    DirectionalLight& light = lights.emplace_back();
    light.toward = glm::normalize(entry.at("toward").direction());
    if (const auto color = entry.find("color")) light.color = parse_color(*color);
    if (const auto shadow = entry.find("shadow")) light.casts_shadow = shadow->boolean();
  }
  return lights;
}

/// A setting as it would be written on the command line.
std::string setting_text(const JsonPlace& place) {
  const nlohmann::json& value = place.value();
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  if (!value.is_array() || value.empty()) place.fail("must be a string, a number, true, false or an array of these");
  std::string list;
  for (size_t i = 0; i < place.size(); ++i) {
    if (place[i].value().is_structured()) place[i].fail("must be a string or a number");
    if (i > 0) list += ',';
    list += setting_text(place[i]);
  }
  return list;
}

/// Names of files begin beside `file`.
std::vector<std::pair<std::string, std::string>> parse_settings(const JsonPlace& place, const fs::path& file) {
  place.only_object();
  std::vector<std::pair<std::string, std::string>> settings;
  for (const auto& [name, ignored] : place.value().items()) {
    std::string text = setting_text(place.at(name.c_str()));
    if (name == "camera" || name == "shaders") text = beside(file, text).string();
    if (name == "config") place.fail("'config' cannot be given in a file");
    settings.emplace_back(name, std::move(text));
  }
  return settings;
}

}  // namespace

bool is_scene_file(const fs::path& path) { return path.extension() == ".json"; }

SceneSource read_scene_file(const fs::path& path) {
  SceneSource result;
  result.argument = path.string();
  result.document = std::make_shared<const nlohmann::json>(read_json_file(path));
  const JsonPlace scene(*result.document, path.string());
  require_known_keys(scene);
  result.meshes = parse_meshes(scene.at("meshes"), path);
  if (const auto up = scene.find("up_axis")) result.up_axis = parse_up_axis(*up);
  result.kinds = parse_kinds(scene);
  if (const auto lights = scene.find("lights")) result.lights = parse_lights(*lights);
  if (const auto ambient = scene.find("ambient")) result.ambient = parse_color(*ambient);
  if (const auto background = scene.find("background")) result.background = parse_color(*background);
  if (scene.has("camera") && scene.has("camera_path")) scene.fail("give either 'camera' or 'camera_path'");
  if (const auto settings = scene.find("settings")) result.settings = parse_settings(*settings, path);
  return result;
}

std::vector<std::pair<std::string, std::string>> read_settings_file(const fs::path& path) {
  const nlohmann::json document = read_json_file(path);
  return parse_settings(JsonPlace(document, path.string()), path);
}

fs::path camera_file_of(const SceneSource& source) {
  if (!source.document || !source.document->contains("camera_path")) return {};
  const nlohmann::json& path = source.document->at("camera_path");
  return path.is_string() ? beside(source.argument, path.get<std::string>()) : fs::path();
}

std::optional<CameraCourse> scene_file_camera(const SceneSource& source, UpAxis up, Warnings& warnings) {
  const JsonPlace scene(*source.document, source.argument);
  if (const auto camera = scene.find("camera")) return parse_camera(*camera, up, warnings);
  const auto course = scene.find("camera_path");
  if (!course) return std::nullopt;
  if (course->is_text()) return read_camera_file(beside(source.argument, course->text()), up, warnings);
  return parse_camera_course(*course, up, warnings);
}

}  // namespace hybridrt
