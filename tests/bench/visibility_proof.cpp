// Asks the rasteriser for the triangle that each pixel sees, at its centre and at several samples of some pixels, and
// compares with a ray tracer in double precision.
//   visibility_proof [--quick] [--threads=N] [--views=N] [--target=NAME] [--seed=N] [SCENE...]
// Each scene is seen from random places in, on and around it, through lenses of 0.02 to 179 degrees; made-up scenes of
// slivers, huge, doubled and coplanar triangles, and with holes, are seen too. --target: an instruction set, as Highway
// names it (AVX2). Exits with 1 if one pixel differs.

#include <cstdlib>
#include <fmt/format.h>
#include <hwy/targets.h>
#include <string_view>

#include "core/base/timing.h"
#include "tests/bench/ray_sets.h"
#include "tests/support/raster_views.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

struct Options {
  bool quick = false;
  int threads = allowed_processors(), views = 0;
  uint32_t seed = 1;
  std::vector<std::string> scenes;
};

struct Tally {
  size_t pixels = 0, hits = 0, wrong = 0;
};

/// A view of the usual size in place of the test's small ones.
View enlarged(View view, bool quick) {
  if (view.width_px < 64 || view.height_px < 48) return view;
  const int width = quick ? 192 : 1024, height = quick ? 144 : 768;
  view.frame_width_px = view.width_px = width, view.frame_height_px = view.height_px = height;
  view.x_px = view.y_px = 0;
  return view;
}

template <typename NextView>
Tally prove(const Scene& scene, const Options& options, ThreadPool& pool, const NextView& next_view) {
  const KdTree tree = build_kd_tree(scene, pool);
  const std::unique_ptr<RayCaster<double>> caster = make_reference_caster(tree);
  const Clusters clusters = make_clusters(scene, pool);
  Random random(options.seed);
  Tally tally;
  for (int i = 0; i < options.views; ++i) {
    const View view = next_view(random);
    const std::vector<uint32_t> truth = reference_ids(*caster, view, pool);
    const std::vector<uint32_t> ids = rasterized_ids(scene, clusters, view, pool);
    tally.pixels += ids.size();
    for (size_t pixel = 0; pixel < ids.size(); ++pixel) {
      tally.hits += truth[pixel] != kNoTriangle;
      if (ids[pixel] == truth[pixel]) continue;
      if (++tally.wrong <= 10)
        printf("  wrong: view %d, pixel %zu of %d x %d: %d, not %d\n", i, pixel, view.width_px, view.height_px,
               static_cast<int>(ids[pixel]), static_cast<int>(truth[pixel]));
    }
    const SampledPixels sampled = sample_some_pixels(scene, clusters, view, pool, random);
    const int wrong = wrong_samples(*caster, sampled, pool);
    if (wrong > 0) printf("  wrong: view %d, %d of %zu samples\n", i, wrong, sampled.triangles.size());
    tally.pixels += sampled.triangles.size(), tally.wrong += wrong;
    for (const uint32_t triangle : sampled.triangles) tally.hits += triangle != kNoTriangle;
  }
  return tally;
}

void print(const char* scene, const Tally& tally) {
  printf("%-44s %12zu %12zu %6zu\n", scene, tally.pixels, tally.hits, tally.wrong);
  fflush(stdout);
}

int64_t target_named(std::string_view name) {
  for (const int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) return target;
  fprintf(stderr, "visibility_proof: no instruction set %s here\n", std::string(name).c_str());
  std::exit(2);
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
    else if (argument.starts_with("--threads="))
      options.threads = std::max(1, std::atoi(argv[i] + 10));
    else if (argument.starts_with("--views="))
      options.views = std::max(1, std::atoi(argv[i] + 8));
    else if (argument.starts_with("--seed="))
      options.seed = static_cast<uint32_t>(std::atoi(argv[i] + 7));
    else if (argument.starts_with("--target="))
      hwy::SetSupportedTargetsForTest(target_named(argument.substr(9)));
    else if (argument.starts_with("--"))
      return fprintf(stderr, "visibility_proof: unknown option %s\n", argv[i]), 2;
    else
      options.scenes.emplace_back(argument);
  }
  if (options.views == 0) options.views = options.quick ? 8 : 24;

  ThreadPool pool(options.threads);
  Tally total;
  const auto add_views = [&](const std::string& name, const Scene& scene, const auto& next_view) {
    const Tally tally = prove(scene, options, pool, next_view);
    print(name.c_str(), tally);
    total.pixels += tally.pixels, total.hits += tally.hits, total.wrong += tally.wrong;
  };
  const auto add = [&](const std::string& name, const Scene& scene) {
    add_views(name, scene, [&](Random& random) { return enlarged(random_view(scene, random), options.quick); });
  };
  printf("%-44s %12s %12s %6s\n", "scene", "pixels", "hits", "wrong");
  const int many = options.quick ? 500 : 40000;
  add("slivers", slivers(1, many));
  add("sizes from 0.01 to 10^6", huge_and_small(2));
  add("soup", random_soup(3, 5 * many, 0.03f));
  add("soup at (10^6, -2 10^6, 3 10^5)", transformed(random_soup(4, many, 0.1f), 100, vec3(1e6f, -2e6f, 3e5f)));
  add("one plane", coplanar_field(5, 800));
  add("doubled, turned", doubled_faces(6));
  const int cells = options.quick ? 64 : 192;
  add_views("centres beside edges by 1e-9 to 1e-3 pixel", sheet_on_centers(cells),
            [&](Random& random) { return sheet_view_beside(cells, random); });
  // So large that every triangle takes the homogeneous way.
  constexpr float kHuge = 0x1p54f;
  add_views("the same, enlarged by 2^54", transformed(sheet_on_centers(cells), kHuge, vec3(0)), [&](Random& random) {
    View view = sheet_view_beside(cells, random);
    view.eye *= kHuge;
    return view;
  });
  add_views("depths that floats hardly tell apart", nearly_one_plane(8),
            [](Random& random) { return view_of_plane(random); });
  add("triples", with_duplicates(7));
  add("holes of all kinds", with_all_kinds_of_holes(random_soup(9, 5 * many, 0.1f), 9));
  // Squares of 4, 12 and 96 pixels are sampled in different ways.
  for (const int step : {1, 3, 24})
    add_views(fmt::format("centres beside texels, squares of {}", step), sheet_of_holes(48, step, 2, step == 3),
              [&](Random& random) { return sheet_view_beside(48, random); });
  if (options.scenes.empty())
    for (const char* name : {"chess", "thin", "spheres"})
      options.scenes.push_back(std::string("scene:") + name +
                               (options.quick ? ",triangles=20000" : ",triangles=500000"));
  for (const std::string& scene : options.scenes) add(scene, load_bench_scene(scene, pool).scene);
  print("all", total);
  return total.wrong > 0;
}
