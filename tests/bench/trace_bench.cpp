// Build time and rays a second of the ray casters, on one thread, over a grid of balls made here.
//   trace_bench --balls_per_side=16 --benchmark_filter=...
// Rays: `primary` from a camera in front, in scanline order; `reflected` mirrored where these hit.

#include <benchmark/benchmark.h>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string_view>

#include "core/trace/embree_caster.h"
#include "core/trace/kd_caster.h"

namespace hybridrt {
namespace {

/// balls_per_side^2 balls of 1,920 triangles in random heights above a floor of two triangles.
Scene make_ball_grid(int balls_per_side) {
  constexpr int kSegments = 40, kRings = 25;
  Scene scene;
  const auto add_quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    scene.triangle_positions.push_back({a, b, c});
    if (d != a) scene.triangle_positions.push_back({a, c, d});
  };
  const float side = static_cast<float>(balls_per_side);
  scene.positions = {{0, 0, 0}, {side, 0, 0}, {side, 0, side}, {0, 0, side}};
  add_quad(0, 1, 2, 3);
  uint32_t random = 1;
  for (int ball = 0; ball < balls_per_side * balls_per_side; ++ball) {
    random = random * 1664525u + 1013904223u;
    const vec3 center(ball % balls_per_side + 0.5f, 0.5f + (random >> 8) * 0x1p-24f,
                      ball / balls_per_side + 0.5f);
    const uint32_t first = static_cast<uint32_t>(scene.positions.size());
    for (int ring = 0; ring <= kRings; ++ring)
      for (int segment = 0; segment < kSegments; ++segment) {
        const double theta = kPi * ring / kRings, phi = 2 * kPi * segment / kSegments;
        scene.positions.push_back(center +
                                  0.45f * vec3(dvec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                                     std::sin(theta) * std::sin(phi))));
      }
    const auto at = [&](int ring, int segment) { return first + ring * kSegments + segment % kSegments; };
    for (int ring = 0; ring < kRings; ++ring)
      for (int segment = 0; segment < kSegments; ++segment) {
        if (ring == 0)
          add_quad(at(0, segment), at(1, segment), at(1, segment + 1), at(0, segment));
        else if (ring == kRings - 1)
          add_quad(at(ring, segment), at(ring + 1, segment), at(ring, segment + 1), at(ring, segment));
        else
          add_quad(at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1),
                   at(ring, segment + 1));
      }
  }
  scene.bounds = compute_bounds(scene);
  return scene;
}

struct Workload {
  Scene scene;
  ThreadPool pool{allowed_processors()};
  KdTree tree;
  std::vector<Ray<float>> primary, reflected;

  explicit Workload(int balls_per_side) : scene(make_ball_grid(balls_per_side)) {
    tree = build_kd_tree(scene, pool);
    const float side = static_cast<float>(balls_per_side);
    const vec3 eye(0.5f * side, 0.4f * side, -0.4f * side), target(0.5f * side, 0, 0.4f * side);
    const vec3 forward = glm::normalize(target - eye),
               right = glm::normalize(glm::cross(forward, vec3(0, 1, 0)));
    const vec3 up = glm::cross(right, forward);
    constexpr int kWidth = 640, kHeight = 480;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        primary.push_back({eye, glm::normalize(forward + right * ((x + 0.5f) / kWidth - 0.5f) * 1.2f +
                                               up * (0.5f - (y + 0.5f) / kHeight) * 0.9f)});
    std::vector<Hit<float>> hits(primary.size());
    make_kd_caster(tree, LeafKernel::simd)->closest_hits(primary, hits);
    for (size_t i = 0; i < hits.size(); ++i) {
      if (!hits[i].found()) continue;
      const vec3 a = scene.vertex(hits[i].triangle, 0), b = scene.vertex(hits[i].triangle, 1),
                 c = scene.vertex(hits[i].triangle, 2);
      const vec3 normal = glm::normalize(glm::cross(b - a, c - a));
      const Ray<float>& ray = primary[i];
      reflected.push_back({ray.origin + hits[i].t * ray.dir, glm::reflect(ray.dir, normal), 1e-3f});
    }
  }
};

void count_rays(benchmark::State& state, size_t rays) {
  state.counters["Mrays/s"] =
      benchmark::Counter(static_cast<double>(rays) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
}

void closest(benchmark::State& state, const RayCaster<float>& caster, const std::vector<Ray<float>>& rays) {
  std::vector<Hit<float>> hits(rays.size());
  for (auto _ : state) caster.closest_hits(rays, hits);
  count_rays(state, rays.size());
}

void any(benchmark::State& state, const RayCaster<float>& caster, const std::vector<Ray<float>>& rays) {
  std::vector<uint8_t> occluded(rays.size());
  for (auto _ : state) caster.any_hits(rays, occluded);
  count_rays(state, rays.size());
}

void build(benchmark::State& state, const Scene& scene, int threads) {
  ThreadPool pool(threads);
  KdTree tree;
  for (auto _ : state) tree = build_kd_tree(scene, pool);
  const double triangles = static_cast<double>(scene.triangle_count());
  const KdTreeShape shape = measure_shape(tree);
  state.counters["triangles"] = triangles;
  state.counters["bytes/triangle"] = static_cast<double>(memory_bytes(tree)) / triangles;
  state.counters["references/triangle"] = static_cast<double>(shape.references) / triangles;
  state.counters["leaves/triangle"] = static_cast<double>(shape.leaves) / triangles;
  state.counters["depth"] = shape.depth;
}

}  // namespace
}  // namespace hybridrt

int main(int argc, char** argv) {
  using namespace hybridrt;
  int balls_per_side = 16;
  constexpr std::string_view kBalls = "--balls_per_side=";
  if (argc > 1 && std::string_view(argv[1]).starts_with(kBalls)) {
    balls_per_side = std::max(1, std::atoi(argv[1] + kBalls.size()));
    argv[1] = argv[0], ++argv, --argc;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;

  const Workload work(balls_per_side);
  const int processors = allowed_processors();
  const auto embree = make_embree_caster(work.scene, processors);
  const auto scalar = make_kd_caster(work.tree, LeafKernel::scalar);
  const auto simd = make_kd_caster(work.tree, LeafKernel::simd);

  for (const int threads : {1, processors})
    benchmark::RegisterBenchmark(("build/kd/threads:" + std::to_string(threads)).c_str(),
                                 [&work, threads](benchmark::State& s) { build(s, work.scene, threads); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  benchmark::RegisterBenchmark(("build/embree/threads:" + std::to_string(processors)).c_str(),
                               [&](benchmark::State& s) {
                                 for (auto _ : s) make_embree_caster(work.scene, processors);
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  const std::pair<std::string, const RayCaster<float>*> casters[] = {
      {"kd_scalar", scalar.get()}, {"kd_simd", simd.get()}, {"embree", embree.get()}};
  const std::pair<std::string, const std::vector<Ray<float>>*> workloads[] = {{"primary", &work.primary},
                                                                              {"reflected", &work.reflected}};
  for (const auto& [rays_name, rays] : workloads)
    for (const auto& [caster_name, caster] : casters) {
      benchmark::RegisterBenchmark(
          ("closest/" + rays_name + "/" + caster_name).c_str(),
          [caster = caster, rays = rays](benchmark::State& s) { closest(s, *caster, *rays); })
          ->Unit(benchmark::kMillisecond);
      benchmark::RegisterBenchmark(
          ("any/" + rays_name + "/" + caster_name).c_str(),
          [caster = caster, rays = rays](benchmark::State& s) { any(s, *caster, *rays); })
          ->Unit(benchmark::kMillisecond);
    }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
