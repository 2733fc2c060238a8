// OM, half-edges and all, the way to a scene.

#include "core/load/mesh_io.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/reader.h"

namespace hybridrt::fuzz {

void read_input(std::string_view bytes) {
  const std::filesystem::path om = input_file("input.om", bytes);
  ThreadPool pool(1);
  Warnings warnings;
  load_meshes({&om, 1}, UpAxis::z, pool, warnings);
}

}  // namespace hybridrt::fuzz
