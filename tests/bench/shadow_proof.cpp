// Asks the light buffer about every pixel that faces the light, and compares with a tracer in double precision.
//   shadow_proof [--quick] [--single] [--threads=N] [SCENE...]
// Each scene is seen from near and far, lies at its place and 1e5 and 1e6 units away from it, and is lit from twelve
// directions, the awkward ones first. Exits with 1 if one answer differs. --quick: small scenes and pictures.
// --single: what a pixel sees is found in single precision, as a frame finds it, so that now and then an origin lies
// behind what hides it.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <random>
#include <string_view>

#include "core/trace/kd_caster.h"
#include "core/trace/primary_surface.h"
#include "tests/bench/ray_sets.h"
#include "tests/support/brute_force.h"
#include "tests/support/primary_shadow_query.h"

namespace hybridrt {
namespace {

constexpr int kLights = 12;
constexpr double kOffsets[] = {0, 1e5, 1e6};

struct Options {
  bool quick = false, single = false;
  int threads = allowed_processors();
  std::vector<std::string> scenes;
};

struct Tally {
  size_t receivers = 0;  ///< pixels that see a triangle
  size_t queries = 0;    ///< from those that see its lit side
  size_t asked = 0;      ///< queries that their cell does not answer
  size_t shadowed = 0, wrong = 0;
  size_t own = 0;  ///< the tracer found only the query's own triangle: its rounding, in a sliver
};

/// Two edges of the largest triangle.
std::pair<dvec3, dvec3> largest_face(const Scene& scene) {
  std::pair<dvec3, dvec3> largest{{1, 0, 0}, {0, 1, 0}};
  double largest_area = 0;
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    const dvec3 a(scene.vertex(i, 0)), e1 = dvec3(scene.vertex(i, 1)) - a, e2 = dvec3(scene.vertex(i, 2)) - a;
    const double area = glm::length(glm::cross(e1, e2));
    if (area > largest_area) largest = {e1, e2}, largest_area = area;
  }
  return largest;
}

std::vector<dvec3> light_directions(const Scene& scene, const View& view) {
  std::mt19937 engine(1);
  const auto random = [&] { return static_cast<double>(engine()) * 0x1p-31 - 1; };
  const double grazing = std::tan(0.5 * kPi / 180), turn = kPi * random();
  const auto [e1, e2] = largest_face(scene);
  const dvec3 along = glm::normalize(e1 + 0.3 * e2), normal = glm::normalize(glm::cross(e1, e2));
  std::vector<dvec3> lights = {
      {0, 1, 0},     {1, 0, 0}, {0, 0, -1},           {0, grazing, 1}, {std::cos(turn), grazing, std::sin(turn)},
      -view.forward, along,     along + 1e-7 * normal};
  while (lights.size() < kLights) lights.push_back({random(), 1 + random(), random()});
  for (dvec3& light : lights) light = glm::normalize(light);
  return lights;
}

void move(BenchScene& bench, double offset) {
  const vec3 by = static_cast<float>(offset) * vec3(1, -1, 0.3f);
  for (vec3& position : bench.scene.positions) position += by;
  bench.scene.bounds = compute_bounds(bench.scene);
  bench.view.eye += dvec3(by);
}

/// From a quarter of the distance to what the middle of the picture shows, or from eight times the distance through a
/// longer lens.
View from_near(View view, const RayCaster<double>& reference) {
  const Ray<double> ray{view.eye, view.forward};
  Hit<double> hit;
  reference.closest_hits({&ray, 1}, {&hit, 1});
  if (hit.found()) view.eye += 0.75 * hit.t * view.forward;
  return view;
}
View from_afar(View view, const Scene& scene) {
  view.eye -= 7 * glm::length(dvec3(scene.bounds.center()) - view.eye) * view.forward;
  view.tan_half_width /= 8, view.tan_half_height /= 8;
  return view;
}

class Proof {
 public:
  Proof(const Scene& scene, bool single, ThreadPool& pool)
      : scene_(scene),
        single_(single),
        pool_(pool),
        sheets_(make_sheets(scene, build_topology(scene, pool), pool)),
        tree_(build_kd_tree(scene, pool)),
        reference_(make_reference_caster(tree_)),
        frame_caster_(make_kd_caster(tree_, LeafKernel::simd)) {}

  const RayCaster<double>& reference() const { return *reference_; }

  void ask(const View& view, Tally& tally) {
    const std::vector<uint32_t> seen = ids(view);
    const auto receivers = seen.size() - static_cast<size_t>(std::ranges::count(seen, kNoTriangle));
    for (const dvec3& toward : light_directions(scene_, view)) {
      tally.receivers += receivers;
      const LightBuffer buffer = build_light_buffer(scene_, sheets_, toward, pool_);
      const bool enclosed = may_be_enclosed(buffer, view.eye);
      std::mutex mutex;
      parallel_for(pool_, seen.size(), static_cast<size_t>(view.width_px), [&](size_t begin, size_t end) {
        std::vector<ShadowQuery> queries;
        for (size_t pixel = begin; pixel < end; ++pixel)
          if (seen[pixel] != kNoTriangle)
            if (auto query = primary_shadow_query(scene_, seen[pixel], view.eye, dir_of(view, pixel), toward)) {
              query->anywhere = enclosed;
              queries.push_back(*query);
            }
        const Tally row = compare(buffer, queries);
        std::lock_guard lock(mutex);
        tally.queries += row.queries, tally.shadowed += row.shadowed, tally.asked += row.asked;
        tally.wrong += row.wrong, tally.own += row.own;
      });
    }
  }

 private:
  static dvec3 dir_of(const View& view, size_t pixel) {
    const auto width = static_cast<size_t>(view.width_px);
    return glm::normalize(view.pixel_dir(static_cast<int>(pixel % width), static_cast<int>(pixel / width)));
  }

  std::vector<uint32_t> ids(const View& view) {
    std::vector<uint32_t> ids(static_cast<size_t>(view.width_px) * view.height_px);
    parallel_for(pool_, ids.size(), static_cast<size_t>(view.width_px), [&](size_t begin, size_t end) {
      single_ ? find<float>(*frame_caster_, view, begin, end, ids) : find<double>(*reference_, view, begin, end, ids);
    });
    return ids;
  }
  template <typename Real>
  static void find(const RayCaster<Real>& caster, const View& view, size_t begin, size_t end,
                   std::vector<uint32_t>& ids) {
    std::vector<Ray<Real>> rays;
    for (size_t pixel = begin; pixel < end; ++pixel)
      rays.push_back({Vec3<Real>(view.eye), Vec3<Real>(dir_of(view, pixel))});
    std::vector<Hit<Real>> hits(rays.size());
    caster.closest_hits(rays, hits);
    for (size_t i = 0; i < hits.size(); ++i) ids[begin + i] = hits[i].triangle;
  }

  Tally compare(const LightBuffer& buffer, const std::vector<ShadowQuery>& queries) const {
    std::vector<uint8_t> occluded(queries.size()), truth(queries.size());
    shadow_answers(buffer, queries, occluded);
    std::vector<CellAnswer> answers(queries.size());
    answers_of_cells(buffer, queries, answers);
    std::vector<Ray<double>> rays;
    for (const ShadowQuery& query : queries) rays.push_back({query.origin, buffer.toward});
    reference_->any_hits(rays, truth);
    Tally tally;
    tally.queries = queries.size();
    for (size_t i = 0; i < queries.size(); ++i) {
      tally.shadowed += truth[i];
      tally.asked += answers[i] == CellAnswer::unknown || answers[i] == CellAnswer::inside;
      if (truth[i] == occluded[i]) continue;
      const uint32_t in_the_way = truth[i] ? brute_force_occluder(scene_, buffer.toward, queries[i]) : kNoTriangle;
      if (truth[i] && in_the_way == kNoTriangle) {
        ++tally.own;
        continue;
      }
      ++tally.wrong;
      tell(buffer, queries[i], in_the_way);
    }
    return tally;
  }

  /// Prints enough to repeat the query.
  void tell(const LightBuffer& buffer, const ShadowQuery& query, uint32_t in_the_way) const {
    static std::atomic<int> told = 0;
    if (told++ >= 20) return;
    const dvec3 &o = query.origin, &l = buffer.toward;
    const auto side = [&](uint32_t triangle) { return triangle == kNoTriangle ? 0 : buffer.sides[triangle]; };
    printf(
        "  wrong: origin %.17g %.17g %.17g, light %.17g %.17g %.17g, triangle %u (side %d, front %d), in its way: "
        "%d (side %d)\n",
        o.x, o.y, o.z, l.x, l.y, l.z, query.triangle, side(query.triangle), query.from_front,
        static_cast<int>(in_the_way), side(in_the_way));
  }

  const Scene& scene_;
  const bool single_;
  ThreadPool& pool_;
  const Sheets sheets_;
  const KdTree tree_;
  const std::unique_ptr<RayCaster<double>> reference_;
  const std::unique_ptr<RayCaster<float>> frame_caster_;
};

Tally prove(const std::string& argument, const Options& options, ThreadPool& pool) {
  Tally tally;
  for (const double offset : kOffsets) {
    BenchScene bench = load_bench_scene(argument, pool);
    if (options.quick) {
      bench.view.width_px = bench.view.frame_width_px = 192;
      bench.view.height_px = bench.view.frame_height_px = 144;
    }
    move(bench, offset);
    Proof proof(bench.scene, options.single, pool);
    proof.ask(from_near(bench.view, proof.reference()), tally);
    proof.ask(from_afar(bench.view, bench.scene), tally);
  }
  return tally;
}

void print(const char* scene, const Tally& tally) {
  const double percent = 100.0 / static_cast<double>(std::max<size_t>(tally.receivers, 1));
  printf("%-40s %6d %10zu %10zu %8.1f%% %8.1f%% %6zu %6zu\n", scene, kLights, tally.receivers, tally.queries,
         percent * static_cast<double>(tally.shadowed), percent * static_cast<double>(tally.asked), tally.wrong,
         tally.own);
  fflush(stdout);
}

}  // namespace
}  // namespace hybridrt

int main(int argc, char** argv) {
  using namespace hybridrt;
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--quick")
      options.quick = true;
    else if (argument == "--single")
      options.single = true;
    else if (argument.starts_with("--threads="))
      options.threads = std::max(1, std::atoi(argv[i] + 10));
    else if (argument.starts_with("--"))
      return fprintf(stderr, "shadow_proof: unknown option %s\n", argv[i]), 2;
    else
      options.scenes.emplace_back(argument);
  }
  if (options.scenes.empty())
    for (const char* name : {"chess", "thin", "spheres"})
      options.scenes.push_back(std::string("scene:") + name +
                               (options.quick ? ",triangles=20000" : ",triangles=500000"));

  ThreadPool pool(options.threads);
  Tally total;
  printf("%-40s %6s %10s %10s %9s %9s %6s %6s\n", "scene", "lights", "receivers", "queries", "shadowed", "asked",
         "wrong", "own");
  for (const std::string& scene : options.scenes) {
    const Tally tally = prove(scene, options, pool);
    print(scene.c_str(), tally);
    total.queries += tally.queries, total.shadowed += tally.shadowed, total.asked += tally.asked;
    total.receivers += tally.receivers;
    total.wrong += tally.wrong, total.own += tally.own;
  }
  if (options.scenes.size() > 1) print("all", total);
  return total.wrong > 0;
}
