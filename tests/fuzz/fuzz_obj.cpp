// OBJ and MTL, all the way to a scene and its topology; cut into small chunks it must read the same. A line "#mtl"
// divides the input: what follows it is the file m.mtl, which the OBJ may name.

#include <stdexcept>

#include "core/base/error.h"
#include "core/load/obj_parse.h"
#include "core/mesh/topology.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/reader.h"
#include "tests/support/load_obj.h"

namespace hybridrt::fuzz {

namespace {

/// The parts of the result that chunks could change.
struct Reading {
  MeshData data;
  Warnings warnings;
  std::string error;

  Reading(const std::filesystem::path& obj, size_t chunk_bytes) {
    ThreadPool pool(1);
    try {
      data = parse_obj(obj, pool, warnings, nullptr, chunk_bytes);
    } catch (const Error& refused) {
      error = refused.what();
      warnings.clear();
    }
  }
  bool operator==(const Reading& other) const {
    return error == other.error && warnings == other.warnings && data.positions == other.data.positions &&
           data.normals == other.data.normals && data.triangle_positions == other.data.triangle_positions &&
           data.triangle_normals == other.data.triangle_normals && data.texcoords == other.data.texcoords &&
           data.triangle_texcoords == other.data.triangle_texcoords &&
           data.triangle_materials == other.data.triangle_materials &&
           data.triangle_places == other.data.triangle_places && data.material_names == other.data.material_names;
  }
};

}  // namespace

void read_input(std::string_view bytes) {
  constexpr std::string_view kDivider = "\n#mtl\n";
  const size_t divider = bytes.find(kDivider);
  input_file("m.mtl", divider == bytes.npos ? "newmtl a\nKd 1 0 0\n" : bytes.substr(divider + kDivider.size()));
  const std::filesystem::path obj = input_file("input.obj", bytes.substr(0, divider));
  if (!(Reading(obj, kObjChunkBytes) == Reading(obj, 16))) throw std::logic_error("chunks change what is read");
  ThreadPool pool(1);
  Warnings warnings;
  const Scene scene = load_obj(obj, pool, warnings);
  build_topology(scene, pool);
}

}  // namespace hybridrt::fuzz
