// Build time and rays per second of everything that answers rays, on the rays that a frame of 1024x768 fires, and whole
// frames compared with a plain Embree program.
//   trace_bench --scene=scene:chess,triangles=500000 [--threads=N] [--benchmark_filter=...]
// Rates are of one thread, by its processor time, unless the name ends in all_threads. `wrong` counts answers that
// differ from a double-precision reference asked for the very same origin. scripts/trace_results.py makes the tables.

#include <benchmark/benchmark.h>
#include <cstdlib>
#include <functional>
#include <string_view>

#include "core/passes_cpu/trace_pass.h"
#include "core/trace/embree_caster.h"
#include "core/trace/kd_caster.h"
#include "tests/bench/embree_frame.h"
#include "tests/bench/ray_sets.h"

namespace hybridrt {
namespace {

struct Workload {
  ThreadPool pool;
  BenchScene bench;
  KdTree tree;
  std::unique_ptr<RayCaster<float>> embree, embree_packets, kd_scalar, kd_simd;
  std::unique_ptr<RayCaster<double>> reference;
  Sheets sheets;
  LightBuffer buffer;
  RaySets sets;

  Workload(const std::string& scene, int threads) : pool(threads), bench(load_bench_scene(scene, pool)) {
    tree = build_kd_tree(bench.scene, pool);
    embree = make_embree_caster(bench.scene, threads, EmbreeRays::single);
    embree_packets = make_embree_caster(bench.scene, threads);
    kd_scalar = make_kd_caster(tree, LeafKernel::scalar);
    kd_simd = make_kd_caster(tree, LeafKernel::simd);
    reference = make_reference_caster(tree);
    sheets = make_sheets(bench.scene, build_topology(bench.scene, pool), pool);
    buffer = build_light_buffer(bench.scene, sheets, bench.toward, pool);
    sets = make_ray_sets(bench, *embree, buffer);
  }
};

using Benchmark = std::function<void(benchmark::State&)>;

benchmark::internal::Benchmark* add(const std::string& name, const Benchmark& body) {
  return benchmark::RegisterBenchmark(name.c_str(), body)->Unit(benchmark::kMillisecond);
}

void count_rays(benchmark::State& state, size_t rays) {
  state.counters["Mrays/s"] =
      benchmark::Counter(static_cast<double>(rays) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
}

size_t wrong_answers(const Workload& work, const std::vector<ShadowQuery>& queries,
                     const std::vector<uint8_t>& occluded) {
  std::vector<Ray<double>> rays;
  for (const ShadowQuery& query : queries) rays.push_back({query.origin, work.bench.toward});
  std::vector<uint8_t> truth(rays.size());
  work.reference->any_hits(rays, truth);
  size_t wrong = 0;
  for (size_t i = 0; i < truth.size(); ++i) wrong += truth[i] != occluded[i];
  return wrong;
}

void add_closest(const std::string& name, const RayCaster<float>& caster, const std::vector<Ray<float>>& rays) {
  if (rays.empty()) return;
  add(name, [&](benchmark::State& state) {
    std::vector<Hit<float>> hits(rays.size());
    for (auto _ : state) caster.closest_hits(rays, hits);
    count_rays(state, rays.size());
  });
}

void add_shadow(const Workload& work, const std::string& set, const std::vector<ShadowQuery>& queries) {
  if (queries.empty()) return;
  const auto rays = std::make_shared<std::vector<Ray<float>>>(as_rays(queries, work.bench.toward));
  const auto add_caster = [&](const std::string& name, const RayCaster<float>& caster) {
    add(set + "/" + name, [&, rays](benchmark::State& state) {
      std::vector<uint8_t> occluded(rays->size());
      for (auto _ : state) caster.any_hits(*rays, occluded);
      count_rays(state, rays->size());
      state.counters["wrong"] = static_cast<double>(wrong_answers(work, queries, occluded));
    });
  };
  add_caster("embree", *work.embree);
  add_caster("embree_packets", *work.embree_packets);
  add_caster("kd_scalar", *work.kd_scalar);
  add_caster("kd_simd", *work.kd_simd);
  add(set + "/light_buffer", [&](benchmark::State& state) {
    std::vector<uint8_t> occluded(queries.size());
    for (auto _ : state) shadow_answers(work.buffer, queries, occluded);
    count_rays(state, queries.size());
    state.counters["wrong"] = static_cast<double>(wrong_answers(work, queries, occluded));
  });
}

/// All threads at once, as in a frame: a tile's rays at a time.
void add_all_threads(Workload& work) {
  constexpr size_t kRaysATime = 1024;
  const auto& queries = work.sets.shadow_all;
  const auto rays = std::make_shared<std::vector<Ray<float>>>(as_rays(queries, work.bench.toward));
  const auto occluded = std::make_shared<std::vector<uint8_t>>(queries.size());
  const auto add_set = [&](const std::string& name, const std::function<void(size_t, size_t)>& answer) {
    add(name + "/all_threads", [&work, &queries, answer](benchmark::State& state) {
      for (auto _ : state) parallel_for(work.pool, queries.size(), kRaysATime, answer);
      count_rays(state, queries.size());
    })->UseRealTime();
  };
  add_set("shadow_all/embree_packets", [&work, rays, occluded](size_t begin, size_t end) {
    work.embree_packets->any_hits(std::span(*rays).subspan(begin, end - begin), {&(*occluded)[begin], end - begin});
  });
  add_set("shadow_all/light_buffer", [&work, &queries, occluded](size_t begin, size_t end) {
    shadow_answers(work.buffer, std::span(queries).subspan(begin, end - begin), {&(*occluded)[begin], end - begin});
  });
}

/// Whole frames: --method raytrace, the same with traced shadow rays, and the plain Embree program.
void add_frames(Workload& work, int threads) {
  const View& view = work.bench.view;
  const size_t pixels = static_cast<size_t>(view.width_px) * view.height_px;
  const auto picture = std::make_shared<std::vector<vec4>>(pixels);
  const auto ids = std::make_shared<std::vector<uint32_t>>(pixels);
  const auto lit = std::make_shared<std::vector<uint8_t>>(pixels);
  const TraceJob plain{work.bench.scene, view, {{{work.bench.toward, vec3(1)}}}};
  const auto add_ours = [&](const std::string& name, const RayCaster<float>& caster, const LightBuffer* buffer) {
    add("frame/" + name, [&work, &caster, buffer, plain, picture, ids, lit](benchmark::State& state) {
      TraceJob job = plain;
      job.lights[0].buffer = buffer;
      for (auto _ : state) trace_frame(job, caster, work.pool, TracedFrame<float>{*picture, *ids, *lit});
    })->UseRealTime();
  };
  add_ours("raytrace", *work.embree_packets, &work.buffer);
  add_ours("raytrace_traced_shadows", *work.embree_packets, nullptr);
  add_ours("raytrace_kd_tree", *work.kd_simd, &work.buffer);
  const auto yardstick = std::make_shared<EmbreeFrame>(work.bench.scene, threads);
  add("frame/plain_embree", [&work, plain, yardstick, picture](benchmark::State& state) {
    for (auto _ : state) yardstick->render(plain, work.pool, *picture);
  })->UseRealTime();
}

void add_builds(Workload& work, int threads) {
  const double triangles = static_cast<double>(work.bench.scene.triangle_count());
  add("build/kd_tree", [&, triangles](benchmark::State& state) {
    KdTree tree;
    for (auto _ : state) tree = build_kd_tree(work.bench.scene, work.pool);
    state.counters["bytes/triangle"] = static_cast<double>(memory_bytes(tree)) / triangles;
  })->UseRealTime();
  add("build/embree", [&, threads](benchmark::State& state) {
    for (auto _ : state) make_embree_caster(work.bench.scene, threads);
  })->UseRealTime();
  add("build/light_buffer", [&, triangles](benchmark::State& state) {
    LightBuffer buffer;
    for (auto _ : state) buffer = build_light_buffer(work.bench.scene, work.sheets, work.bench.toward, work.pool);
    state.counters["bytes/triangle"] = static_cast<double>(memory_bytes(buffer)) / triangles;
    state.counters["entries"] = static_cast<double>(buffer.entries.size());
    state.counters["cells"] = static_cast<double>(buffer.cells.size() - 1);
  })->UseRealTime();
}

}  // namespace
}  // namespace hybridrt

int main(int argc, char** argv) {
  using namespace hybridrt;
  benchmark::Initialize(&argc, argv);
  std::string scene = "scene:chess,triangles=500000";
  int threads = allowed_processors();
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument.starts_with("--scene="))
      scene = argument.substr(8);
    else if (argument.starts_with("--threads="))
      threads = std::max(1, std::atoi(argv[i] + 10));
    else
      return fprintf(stderr, "trace_bench: unknown option %s\n", argv[i]), 2;
  }

  Workload work(scene, threads);
  printf(
      "%s: %zu triangles; rays: %zu primary, %zu shadow, %zu of marked pixels, %zu/%zu reflected "
      "flat/curved, "
      "%zu refracted; %d threads build\n",
      scene.c_str(), work.bench.scene.triangle_count(), work.sets.primary.size(), work.sets.shadow_all.size(),
      work.sets.shadow_marked.size(), work.sets.reflected_flat.size(), work.sets.reflected_curved.size(),
      work.sets.refracted.size(), threads);
  add_builds(work, threads);
  add_shadow(work, "shadow_all", work.sets.shadow_all);
  add_shadow(work, "shadow_marked", work.sets.shadow_marked);
  add_all_threads(work);
  add_frames(work, threads);
  const std::pair<std::string, const std::vector<Ray<float>>*> sets[] = {
      {"primary", &work.sets.primary},
      {"reflected_flat", &work.sets.reflected_flat},
      {"reflected_curved", &work.sets.reflected_curved},
      {"refracted", &work.sets.refracted}};
  for (const auto& [name, rays] : sets) {
    add_closest(name + "/embree", *work.embree, *rays);
    add_closest(name + "/embree_packets", *work.embree_packets, *rays);
    add_closest(name + "/kd_scalar", *work.kd_scalar, *rays);
    add_closest(name + "/kd_simd", *work.kd_simd, *rays);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
