#include "core/load/scene_source.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/loading_bytes.h"
#include "core/load/mesh_io.h"
#include "core/load/scene_file.h"
#include "core/load/text_scan.h"
#include "core/procedural/procedural.h"

namespace hybridrt {
namespace {

constexpr std::string_view kPrefix = "scene:";

/// Takes what stands before the next comma off `rest`.
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

Scene make_procedural(const std::string& argument, uint64_t most_bytes) {
  std::string_view rest = std::string_view(argument).substr(kPrefix.size());
  const std::string_view name = take_part(rest);
  const ProceduralScene* scene = find_procedural(name);
  if (!scene)
    throw error(ErrorKind::usage, "{}: there is no procedural scene {}; there are: {}", argument, in_quotes(name),
                procedural_names());
  ProceduralOptions options;
  while (!rest.empty()) {
    const std::string_view part = take_part(rest);
    const size_t equals = part.find('=');
    const std::string_view key = part.substr(0, equals);
    const std::string_view value = equals == part.npos ? std::string_view() : part.substr(equals + 1);
    if (key == "triangles") {
      const double triangles = parse_value(argument, key, value);
      if (triangles != std::floor(triangles) || std::abs(triangles) > 1e15)
        throw error(ErrorKind::usage, "{}: triangles needs a whole number, not {}", argument, in_quotes(value));
      options.triangles = static_cast<int64_t>(triangles);
    } else if (key == "reflective") {
      options.reflective_percent = parse_value(argument, key, value);
    } else {
      throw error(ErrorKind::usage, "{}: unknown key {}; allowed: triangles=N, reflective=PERCENT", argument,
                  in_quotes(key));
    }
  }
  const int64_t triangles = std::min(options.triangles.value_or(scene->default_triangles), scene->most_triangles);
  require_room_for_scene(argument, making_bytes(triangles), most_bytes);
  return scene->make(options);
}

}  // namespace

Scene load_scene(const std::string& scene_argument, ThreadPool& pool, Warnings& warnings, std::optional<UpAxis> up_axis,
                 const LoadWatch& watch) {
  if (scene_argument.starts_with(kPrefix)) {
    if (up_axis.value_or(UpAxis::y) != UpAxis::y)
      throw error(ErrorKind::usage, "{}: its y axis points up; leave --up-axis out", scene_argument);
    return make_procedural(scene_argument, watch.most_bytes);
  }
  const std::filesystem::path path(scene_argument);
  std::error_code unreachable;
  if (!std::filesystem::exists(path, unreachable))
    throw error(ErrorKind::input, "{} does not exist; SCENE is a {} file, a scene .json or scene:NAME ({})",
                scene_argument, kMeshFormats, procedural_names());
  if (is_scene_file(path)) {
    const SceneDescription description = read_scene_file(path);
    const UpAxis up = up_axis ? *up_axis : description.up_axis.value_or(UpAxis::y);
    return load_meshes(description.meshes, up, pool, warnings, watch);
  }
  if (!is_mesh_file(path) && !std::filesystem::is_directory(path, unreachable))
    throw error(ErrorKind::input, "{}: {} files are not read, only {} and scene .json; convert it to one of these",
                scene_argument, path.has_extension() ? path.extension().string() : "such", kMeshFormats);
  return load_meshes({&path, 1}, up_axis.value_or(UpAxis::y), pool, warnings, watch);
}

}  // namespace hybridrt
