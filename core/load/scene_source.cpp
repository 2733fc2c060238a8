#include "core/load/scene_source.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/load/loading_bytes.h"
#include "core/load/mesh_format.h"
#include "core/load/mesh_io.h"
#include "core/load/scene_file.h"
#include "core/load/text_scan.h"

namespace hybridrt {
namespace {

constexpr std::string_view kPrefix = "scene:";

/// Takes the part before the next comma off `rest`.
std::string_view take_part(std::string_view& rest) {
  const size_t comma = std::min(rest.find(','), rest.size());
  const std::string_view part = rest.substr(0, comma);
  rest.remove_prefix(std::min(comma + 1, rest.size()));
  return part;
}

double parse_value(const std::string& argument, std::string_view key, std::string_view value) {
  const std::optional<double> number = parse_number(value);
  if (!number) throw error(ErrorKind::usage, "{}: {} needs a number, not {}", argument, key, in_quotes(value));
  return *number;
}

/// A count like 500000, 500k or 2M.
double parse_count(const std::string& argument, std::string_view key, std::string_view value) {
  double unit = 1;
  if (value.ends_with('k') || value.ends_with('K')) unit = 1e3;
  if (value.ends_with('M')) unit = 1e6;
  if (unit > 1) value.remove_suffix(1);
  return unit * parse_value(argument, key, value);
}

/// "triangles, reflective".
std::string parameter_names(const ProceduralScene& scene) {
  std::string names;
  for (const SceneParameter& parameter : scene.parameters)
    names.append(names.empty() ? "" : ", ").append(parameter.name);
  return names;
}

/// Reads `key=value` into `values`.
void parse_parameter(const std::string& argument, std::string_view part, const ProceduralScene& scene,
                     SceneValues& values) {
  const size_t equals = part.find('=');
  const std::string_view key = part.substr(0, equals);
  const std::string_view value = equals == part.npos ? std::string_view() : part.substr(equals + 1);
  const SceneParameter* parameter = scene.parameter(key);
  if (!parameter)
    throw error(ErrorKind::usage, "{}: unknown key {}; allowed, each as KEY=NUMBER: {}", argument, in_quotes(key),
                parameter_names(scene));
  const double number = parameter->is_count ? parse_count(argument, key, value) : parse_value(argument, key, value);
  check_value(scene, *parameter, number);
  values.insert_or_assign(std::string(key), number);
}

SceneSource parse_procedural(const std::string& argument) {
  std::string_view rest = std::string_view(argument).substr(kPrefix.size());
  const std::string_view name = take_part(rest);
  SceneSource source;
  source.procedural = find_procedural(name);
  if (!source.procedural)
    throw error(ErrorKind::usage, "{}: there is no procedural scene {}; there are: {}", argument, in_quotes(name),
                procedural_names());
  while (!rest.empty()) parse_parameter(argument, take_part(rest), *source.procedural, source.procedural_values);
  const SceneShot shot = source.procedural->shot(source.procedural_values);
  if (shot.camera) source.shot = orbit_through(*shot.camera);
  source.lights = shot.lights;
  source.ambient = shot.ambient;
  source.background = shot.background;
  return source;
}

SceneSource parse_path(const std::filesystem::path& path) {
  std::error_code unreachable;
  if (!std::filesystem::exists(path, unreachable))
    throw error(ErrorKind::input, "{} does not exist; SCENE is a {} file, a scene .json or scene:NAME ({})",
                path.string(), kMeshFormats, procedural_names());
  if (is_scene_file(path)) return read_scene_file(path);
  if (!is_mesh_file(path) && !std::filesystem::is_directory(path, unreachable))
    throw error(ErrorKind::input, "{}: {} files are not read, only {} and scene .json; convert it to one of these",
                path.string(), path.has_extension() ? path.extension().string() : "such", kMeshFormats);
  SceneSource source;
  source.meshes = {path};
  return source;
}

}  // namespace

SceneSource parse_scene_source(const std::string& argument) {
  SceneSource source = argument.starts_with(kPrefix) ? parse_procedural(argument) : parse_path(argument);
  source.argument = argument;
  return source;
}

std::string short_name(const SceneSource& source) {
  if (source.procedural) return std::string(source.procedural->name);
  const bool has_file = source.argument != "-";
  return (has_file ? std::filesystem::path(source.argument) : source.meshes.front()).stem().string();
}

std::optional<CameraCourse> camera_of(const SceneSource& source, UpAxis up, Warnings& warnings) {
  return source.document ? scene_file_camera(source, up, warnings) : source.shot;
}

Scene load_scene(const SceneSource& source, std::optional<UpAxis> up_axis, ThreadPool& pool, Warnings& warnings,
                 const LoadWatch& watch) {
  const UpAxis up = up_axis ? *up_axis : source.up_axis.value_or(UpAxis::y);
  if (!source.procedural)
    return load_meshes(source.meshes, up, pool, warnings, watch, source.kinds, source.names_begin_in);
  if (up != UpAxis::y) throw error(ErrorKind::usage, "{}: its y axis points up; leave --up-axis out", source.argument);
  const ProceduralScene& scene = *source.procedural;
  require_room_for_scene(source.argument, making_bytes(scene.triangles(source.procedural_values)), watch.most_bytes);
  return scene.make(source.procedural_values);
}

}  // namespace hybridrt
