#include "core/load/obj_io.h"

#include "core/load/assemble_scene.h"
#include "core/load/mtl_io.h"
#include "core/load/obj_parse.h"

namespace hybridrt {

Scene load_obj(const std::filesystem::path& path, ThreadPool& pool, Warnings& warnings) {
  std::vector<LoadedMesh> meshes(1);
  meshes[0].data = parse_obj(path, pool, warnings);
  meshes[0].library = read_libraries(path.parent_path(), meshes[0].data.libraries, meshes[0].library_files, warnings);
  return assemble_scene(std::move(meshes), pool, warnings);
}

}  // namespace hybridrt
