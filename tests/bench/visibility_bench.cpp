// Times the triangle ids of a picture: the rasteriser against Embree's packets and streams, on the same rays.
//   visibility_bench [--threads=N] [--rounds=N] [--size=1024x768] [--target=NAME] SCENE...
// Each scene is seen as in its pictures, from its middle, and from low beside it. Candidates take turns; medians of the
// rounds are printed in milliseconds, and the ratio of Embree's fastest to the rasteriser's.

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/timing.h"
#include "core/raster/visibility.h"
#include "tests/bench/bench_options.h"
#include "tests/bench/embree_primary.h"
#include "tests/bench/ray_sets.h"

namespace hybridrt {
namespace {

struct NamedView {
  const char* name;
  View view;
};

std::vector<NamedView> views_of(const BenchScene& bench, const BenchOptions& options) {
  const auto sized = [&](View view) {
    view.tan_half_width = view.tan_half_height * options.width_px / options.height_px;
    view.width_px = view.frame_width_px = options.width_px;
    view.height_px = view.frame_height_px = options.height_px;
    return view;
  };
  const Aabb& box = bench.scene.bounds;
  const dvec3 middle(box.center()), extent(box.extent());
  Camera inside, grazing;
  inside.eye_world = middle + 0.03 * extent,
  inside.target_world = middle + 0.4 * dvec3(extent.x, -0.2 * extent.y, extent.z);
  inside.fov_y_rad = kPi / 3;
  grazing.eye_world = middle + dvec3(0.6 * extent.x, -0.35 * extent.y, 0.5 * extent.z);
  grazing.target_world = middle - 0.3 * dvec3(0, extent.y, 0);
  return {{"default", sized(bench.view)},
          {"inside", make_view(inside, dvec3(0), options.width_px, options.height_px)},
          {"grazing", make_view(grazing, dvec3(0), options.width_px, options.height_px)}};
}

struct Candidate {
  std::string name;
  std::function<void()> run;
  std::vector<double> ms;

  double median() {
    std::sort(ms.begin(), ms.end());
    return ms[ms.size() / 2];
  }
};

/// Returns the ratio.
double compare(const std::string& scene_name, const NamedView& view, const BenchScene& bench, const Clusters& clusters,
               const EmbreePrimary& robust, const EmbreePrimary& plain, ThreadPool& pool, const BenchOptions& options) {
  std::vector<uint32_t> ids(static_cast<size_t>(options.width_px) * options.height_px);
  RasterMemory memory;
  std::vector<Candidate> candidates = {
      {"raster", [&] { rasterize_ids(bench.scene, clusters, view.view, pool, memory, ids); }, {}}};
  for (const int packet : {4, 8, 16, 0})
    for (const EmbreePrimary* embree : {&robust, &plain})
      candidates.push_back({(packet ? std::to_string(packet) : std::string("stream")) + (embree == &robust ? "r" : ""),
                            [&, packet, embree] { embree->find(view.view, packet, pool, ids); },
                            {}});
  for (int round = -1; round < options.rounds; ++round)
    for (Candidate& candidate : candidates) {
      const Stopwatch watch;
      candidate.run();
      if (round >= 0) candidate.ms.push_back(watch.elapsed_ms());
    }
  double fastest = 1e30;
  printf("\"%s\",%s", scene_name.c_str(), view.name);
  for (Candidate& candidate : candidates) {
    if (&candidate != &candidates.front()) fastest = std::min(fastest, candidate.median());
    printf(",%.2f", candidate.median());
  }
  const double ratio = fastest / candidates.front().median();
  printf(",%.2f\n", ratio);
  fflush(stdout);
  return ratio;
}

}  // namespace
}  // namespace hybridrt

int main(int argc, char** argv) {
  using namespace hybridrt;
  const BenchOptions options = parse_bench_options(argc, argv);
  ThreadPool pool(options.threads);
  double log_sum = 0;
  int count = 0;
  printf("scene,view,raster,4r,4,8r,8,16r,16,streamr,stream,ratio\n");
  for (const std::string& name : options.scenes) {
    const BenchScene bench = load_bench_scene(name, pool);
    const Stopwatch building;
    const Clusters clusters = make_clusters(bench.scene, pool);
    const double clusters_ms = building.elapsed_ms();
    const Stopwatch building_embree;
    const EmbreePrimary robust(bench.scene, options.threads, true);
    const double embree_ms = building_embree.elapsed_ms();
    const EmbreePrimary plain(bench.scene, options.threads, false);
    fprintf(stderr, "%s: %zu triangles; clusters built in %.0f ms, Embree's tree in %.0f\n", name.c_str(),
            bench.scene.triangle_count(), clusters_ms, embree_ms);
    for (const NamedView& view : views_of(bench, options)) {
      log_sum += std::log(compare(name, view, bench, clusters, robust, plain, pool, options));
      ++count;
    }
  }
  printf("geometric mean of %d views: %.2f\n", count, std::exp(log_sum / count));
  return 0;
}
