#include "core/load/mesh_io.h"

#include <exception>
#include <unordered_set>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/load/assemble_scene.h"
#include "core/load/loading_bytes.h"
#include "core/load/mesh_format.h"
#include "core/load/mtl_io.h"
#include "core/load/obj_parse.h"
#include "core/load/off_io.h"
#include "core/load/om_io.h"
#include "core/load/ply_io.h"
#include "core/load/stl_io.h"

namespace hybridrt {
namespace {

constexpr uint64_t kLargeObj = uint64_t{4} << 20;  // worth all threads

uint64_t file_bytes(const std::filesystem::path& path) {
  std::error_code unreadable;
  const uint64_t bytes = std::filesystem::file_size(path, unreadable);
  return unreadable ? 0 : bytes;
}

MeshData read_mesh(const std::filesystem::path& path, ThreadPool& pool, Warnings& warnings, LoadProgress* progress) {
  if (mesh_format_of(path) == MeshFormat::obj) return parse_obj(path, pool, warnings, progress);
  MeshData mesh = mesh_format_of(path) == MeshFormat::ply   ? read_ply(path, warnings)
                  : mesh_format_of(path) == MeshFormat::off ? read_off(path, warnings)
                  : mesh_format_of(path) == MeshFormat::om  ? read_om(path, warnings)
                                                            : read_stl(path, warnings);
  if (progress) progress->bytes_read += file_bytes(path);
  return mesh;
}

void turn(MeshData& mesh, UpAxis up) {
  if (up == UpAxis::y) return;
  for (dvec3& p : mesh.positions) p = y_up_from_files(up, p);
  for (vec3& n : mesh.normals) n = y_up_from_files(up, n);
}

/// Refuses names that mean no material.
void require_known(const MaterialKinds& kinds, const std::vector<LoadedMesh>& meshes) {
  std::unordered_set<std::string_view> known;
  for (const LoadedMesh& mesh : meshes)
    for (const Material& material : mesh.library) known.insert(material.name);
  const auto check = [&](const char* key, const std::vector<std::string>& names) {
    for (const std::string& name : names)
      if (!known.contains(name))
        throw error(ErrorKind::input, "{}: {}: no MTL file of its meshes defines the material {}; check the name",
                    kinds.where, key, in_quotes(name));
  };
  check("glass", kinds.glass);
  check("opaque", kinds.opaque);
}

}  // namespace

Scene load_meshes(std::span<const std::filesystem::path> paths, UpAxis up, ThreadPool& pool, Warnings& warnings,
                  const LoadWatch& watch, const MaterialKinds& kinds, const std::filesystem::path& names_begin_in) {
  HRT_CHECK(!paths.empty());
  uint64_t memory_bytes = 0;
  for (const std::filesystem::path& path : paths) {
    require_regular_file(path);
    memory_bytes += loading_bytes(path);
    if (watch.progress) watch.progress->bytes += file_bytes(path);
  }
  require_room_for_scene(paths.front().string() + (paths.size() > 1 ? " and the other meshes" : ""), memory_bytes,
                         watch.most_bytes);

  std::vector<LoadedMesh> meshes(paths.size());
  std::vector<Warnings> own_warnings(paths.size());
  std::vector<std::exception_ptr> failures(paths.size());
  const auto read = [&](size_t i, ThreadPool& own_pool) {
    try {
      LoadedMesh& mesh = meshes[i];
      mesh.data = read_mesh(paths[i], own_pool, own_warnings[i], watch.progress);
      const std::filesystem::path folder = names_begin_in.empty() ? paths[i].parent_path() : names_begin_in;
      mesh.library = read_libraries(folder, mesh.data.libraries, mesh.library_files, own_warnings[i], kinds);
      if (!mesh.data.materials.empty()) mesh.library = std::move(mesh.data.materials);
      turn(mesh.data, up);
    } catch (...) {
      failures[i] = std::current_exception();
    }
  };
  std::vector<size_t> small;
  for (size_t i = 0; i < paths.size(); ++i)
    if (paths.size() == 1 || (mesh_format_of(paths[i]) == MeshFormat::obj && file_bytes(paths[i]) >= kLargeObj))
      read(i, pool);
    else
      small.push_back(i);
  pool.run(small.size(), [&](size_t i, int) {
    ThreadPool alone(1);
    read(small[i], alone);
  });
  for (const std::exception_ptr& failure : failures)  // that of the first file, not of the first thread
    if (failure) std::rethrow_exception(failure);
  require_known(kinds, meshes);
  for (const Warnings& own : own_warnings) warnings.insert(warnings.end(), own.begin(), own.end());
  return assemble_scene(std::move(meshes), pool, warnings, watch);
}

}  // namespace hybridrt
