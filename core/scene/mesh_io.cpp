#include "core/scene/mesh_io.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/scene/assemble_scene.h"
#include "core/scene/loading_bytes.h"
#include "core/scene/mtl_io.h"
#include "core/scene/obj_parse.h"

namespace hybridrt {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

MeshData read_mesh(const std::filesystem::path& path, Warnings& warnings) {
  switch (mesh_format_of(path)) {
    case MeshFormat::ply: return read_ply(path, warnings);
    case MeshFormat::off: return read_off(path, warnings);
    case MeshFormat::stl: return read_stl(path, warnings);
    case MeshFormat::obj: break;
  }
  return parse_obj(path, warnings);
}

void turn(MeshData& mesh, UpAxis up) {
  if (up == UpAxis::y) return;
  for (dvec3& p : mesh.positions) p = y_up_from_files(up, p);
  for (vec3& n : mesh.normals) n = y_up_from_files(up, n);
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
  return mesh_format_of(path) != MeshFormat::obj || extension_of(path) == ".obj";
}

MeshFormat mesh_format_of(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".off") return MeshFormat::off;
  if (extension == ".stl") return MeshFormat::stl;
  return MeshFormat::obj;
}

Scene load_meshes(std::span<const std::filesystem::path> paths, UpAxis up, ThreadPool& pool,
                  Warnings& warnings, uint64_t most_bytes) {
  HRT_CHECK(!paths.empty());
  uint64_t bytes = 0;
  for (const std::filesystem::path& path : paths) bytes += loading_bytes(path);
  require_room_for_scene(paths.front().string() + (paths.size() > 1 ? " and the other meshes" : ""), bytes, most_bytes);
  std::vector<LoadedMesh> meshes(paths.size());
  std::vector<Warnings> own_warnings(paths.size());
  pool.run(paths.size(), [&](size_t i, int) {
    LoadedMesh& mesh = meshes[i];
    mesh.data = read_mesh(paths[i], own_warnings[i]);
    mesh.library = read_libraries(paths[i].parent_path(), mesh.data.libraries, mesh.library_files, own_warnings[i]);
    turn(mesh.data, up);
  });
  for (const Warnings& own : own_warnings) warnings.insert(warnings.end(), own.begin(), own.end());
  return assemble_scene(std::move(meshes), pool, warnings);
}

}  // namespace hybridrt
