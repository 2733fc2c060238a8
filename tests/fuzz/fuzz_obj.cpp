// OBJ and MTL, all the way to a scene and its topology. A line "#mtl" divides the input: what stands behind it is the
// file m.mtl, which the OBJ may name.

#include "core/scene/obj_io.h"
#include "core/scene/topology.h"
#include "tests/fuzz/input_file.h"
#include "tests/fuzz/reader.h"

namespace hybridrt::fuzz {

void read_input(std::string_view bytes) {
  constexpr std::string_view kDivider = "\n#mtl\n";
  const size_t divider = bytes.find(kDivider);
  input_file("m.mtl", divider == bytes.npos ? "newmtl a\nKd 1 0 0\n" : bytes.substr(divider + kDivider.size()));
  const std::filesystem::path obj = input_file("input.obj", bytes.substr(0, divider));
  ThreadPool pool(1);
  Warnings warnings;
  const Scene scene = load_obj(obj, pool, warnings);
  build_topology(scene, pool);
}

}  // namespace hybridrt::fuzz
