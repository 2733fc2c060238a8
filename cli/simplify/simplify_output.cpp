#include "cli/simplify/simplify_output.h"

#include <system_error>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/load/loading_bytes.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

/// Half-edges, quadrics and samples of a triangle, as measured, and the simplified scene's share.
constexpr uint64_t kBytesPerTriangle = 1000;

std::vector<fs::path> inputs_of(const SceneSource& source, const Scene& scene) {
  std::vector<fs::path> inputs{source.argument};
  inputs.insert(inputs.end(), scene.files.begin(), scene.files.end());
  for (const Material& material : scene.materials)
    for (const TextureMap& map : material.maps) inputs.push_back(map.path);
  return inputs;
}

bool is_texture(const Scene& scene, const fs::path& file) {
  for (const Material& material : scene.materials)
    for (const TextureMap& map : material.maps)
      if (map.path == file) return true;
  return false;
}

}  // namespace

SimplifyOutput prepare_simplify_output(const fs::path& obj, const SceneSource& source, const Scene& scene) {
  if (obj.extension() != ".obj") throw error(ErrorKind::usage, "-o {}: give a name that ends in .obj", obj.string());
  SimplifyOutput output{obj, fs::path(obj).replace_extension(".mtl"), std::make_unique<FileClaims>()};
  for (const fs::path& file : {output.obj, output.mtl}) {
    for (const fs::path& input : inputs_of(source, scene)) {
      std::error_code no_such_file;
      if (!input.empty() && fs::equivalent(file, input, no_such_file))
        throw error(ErrorKind::usage, "{} would replace {}, which the scene is read from; give -o another name",
                    file.string(), input.string());
    }
    require_writable(file);
    if (output.claims->claim(file) == FileClaims::Answer::taken)
      throw error(ErrorKind::output, "{} is being written by another run; wait for it or give -o another name",
                  file.string());
  }
  return output;
}

std::optional<uint64_t> bytes_of_files(const Scene& scene) {
  uint64_t bytes = 0;
  for (const std::string& file : scene.files) {
    if (is_texture(scene, file)) continue;
    std::error_code failed;
    const uint64_t size = fs::file_size(file, failed);
    if (failed) return std::nullopt;
    bytes += size;
  }
  return bytes > 0 ? std::optional(bytes) : std::nullopt;
}

void warn_of_what_is_not_geometry(const SceneSource& source, const fs::path& obj, Warnings& warnings) {
  if (source.document)
    warnings.emplace_back(
        WarningCode::scene_parts_lost,
        fmt::format("{} holds no lights, cameras and settings; name it under \"meshes\" in a copy of {}",
                    obj.filename().string(), fs::path(source.argument).filename().string()));
}

void require_room_to_simplify(const RenderJob& job, const SceneSource& source) {
  require_room_for_scene(source.argument, kBytesPerTriangle * job.scene.triangle_count(), job.most_bytes);
}

}  // namespace hybridrt::cli
