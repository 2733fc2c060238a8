// Where the bytes of a scene are: each structure that a frame may need is built in turn.
//   memory_bench [--threads=N] SCENE...
// A line per structure: its bytes per triangle by the sizes of its arrays, what the process's resident memory grew by,
// and the highest it was meanwhile, above what was there before the scene. Sizes are exact; Embree's tree is known only
// by what is resident.

#include <fstream>
#include <malloc.h>
#include <optional>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

#include "core/base/memory.h"
#include "core/base/timing.h"
#include "core/raster/clusters.h"
#include "core/render/scene_caster.h"
#include "core/trace/light_buffer.h"
#include "tests/bench/bench_options.h"
#include "tests/bench/ray_sets.h"

namespace hybridrt {
namespace {

/// From /proc/self/status, in bytes.
double status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return 1024 * std::stod(line.substr(key.size() + 1));
  return 0;
}

/// Resident memory, without what the allocator keeps of what was freed.
double resident_bytes() {
  malloc_trim(0);
  return status_bytes("VmRSS");
}

/// Lets the kernel forget the highest so far.
void forget_peak() { std::ofstream("/proc/self/clear_refs") << '5'; }

size_t bytes_of_scene(const Scene& scene) {
  return bytes_of(scene.positions) + bytes_of(scene.normals) + bytes_of(scene.triangle_positions) +
         bytes_of(scene.triangle_normals) + bytes_of(scene.triangle_materials) + bytes_of(scene.colors) +
         bytes_of(scene.triangle_colors) + (scene.textures ? scene.textures->memory_bytes() : 0);
}

class Table {
 public:
  explicit Table(std::string scene) : scene_(std::move(scene)), start_(resident_bytes()), before_(start_) {
    forget_peak();
  }
  void begin() { watch_.restart(), before_ = resident_bytes(), forget_peak(); }
  void row(const char* structure, size_t bytes, size_t triangles) {
    const double ms = watch_.elapsed_ms(), peak = status_bytes("VmHWM"), now = resident_bytes();
    const auto each = [&](double sum) { return sum / static_cast<double>(triangles); };
    printf("\"%s\",%zu,%s,%.1f,%.1f,%.1f,%.1f,%.0f\n", scene_.c_str(), triangles, structure,
           each(static_cast<double>(bytes)), each(now - before_), each(now - start_), each(peak - start_), ms);
    fflush(stdout);
    begin();
  }

 private:
  const std::string scene_;
  const double start_;
  double before_;
  Stopwatch watch_;
};

void measure(const std::string& name, const BenchOptions&, ThreadPool& pool) {
  Table table(name);
  const BenchScene bench = load_bench_scene(name, pool);
  const Scene& scene = bench.scene;
  const size_t triangles = scene.triangle_count();
  table.row("scene", bytes_of_scene(scene), triangles);
  const Topology topology = build_topology(scene, pool);
  table.row("topology", memory_bytes(topology), triangles);
  const Sheets sheets = make_sheets(scene, topology, pool);
  table.row("sheets", memory_bytes(sheets), triangles);
  const Clusters clusters = make_clusters(scene, pool);
  table.row("clusters", memory_bytes(clusters), triangles);
  const LightBuffer buffer = build_light_buffer(scene, sheets, bench.toward, pool);
  table.row("light buffer", memory_bytes(buffer), triangles);
  printf("# %zu cells, %zu entries, %zu others\n", buffer.cells.size(), buffer.entries.size(), buffer.others.size());
  {
    const SceneCaster<float> caster = make_scene_caster(scene, Accel::kdtree, pool);
    table.row("kd-tree", memory_bytes(*caster.tree), triangles);
  }
  table.begin();
  const SceneCaster<float> caster = make_scene_caster(scene, Accel::embree, pool);
  table.row("Embree", 0, triangles);
}

}  // namespace
}  // namespace hybridrt

int main(int argc, char** argv) {
  return hybridrt::print_table(
      argc, argv, "scene,triangles,structure,bytes per triangle,resident,resident in all,peak meanwhile,ms",
      hybridrt::measure);
}
