#include "tests/bench/ray_sets.h"

#include "core/image_io/read_image.h"
#include "core/load/scene_source.h"
#include "core/procedural/procedural.h"
#include "core/trace/scatter.h"
#include "core/trace/surface_at.h"

namespace hybridrt {
namespace {

constexpr int kWidth_px = 1024, kHeight_px = 768, kTile_px = 32, kMarkRadius_px = 2;

/// Goes tile by tile, and within a tile in blocks of 4 x 4, which are the packets of 16.
template <typename Body>
void for_each_pixel_in_tiles(const Body& body) {
  for (int tile_y = 0; tile_y < kHeight_px; tile_y += kTile_px)
    for (int tile_x = 0; tile_x < kWidth_px; tile_x += kTile_px)
      for (int block_y = tile_y; block_y < tile_y + kTile_px; block_y += 4)
        for (int block_x = tile_x; block_x < tile_x + kTile_px; block_x += 4)
          for (int y = block_y; y < block_y + 4; ++y)
            for (int x = block_x; x < block_x + 4; ++x) body(x, y);
}

size_t index_of(int x, int y) { return static_cast<size_t>(y) * kWidth_px + x; }

}  // namespace

BenchScene load_bench_scene(const std::string& argument, ThreadPool& pool) {
  Warnings warnings;
  BenchScene made;
  const SceneSource source = parse_scene_source(argument);
  LoadWatch watch;
  watch.textures = {texel_size, read_texels};
  made.scene = load_scene(source, std::nullopt, pool, warnings, watch);
  const SceneShot shot = source.procedural ? source.procedural->shot(source.procedural_values) : SceneShot();
  const Camera camera =
      shot.camera
          ? *shot.camera
          : camera_on_orbit(default_orbit(made.scene, made.scene.bounds, double(kWidth_px) / kHeight_px, 0.7), 0.07);
  made.view = make_view(camera, made.scene.origin_world, kWidth_px, kHeight_px);
  made.toward = shot.lights ? glm::normalize(shot.lights->front().toward)
                            : glm::normalize(dvec3(0, 1, 0) - 0.6 * made.view.right + 0.3 * made.view.forward);
  return made;
}

RaySets make_ray_sets(const BenchScene& bench, const RayCaster<float>& caster, const LightBuffer& buffer) {
  const Scene& scene = bench.scene;
  RaySets sets;
  for_each_pixel_in_tiles([&](int x, int y) {
    sets.primary.push_back({vec3(bench.view.eye), vec3(glm::normalize(bench.view.pixel_dir(x, y)))});
  });
  std::vector<Hit<float>> hits(sets.primary.size());
  caster.closest_hits(sets.primary, hits);

  Material glass;
  glass.transmit = vec3(1);
  glass.ni = 1.5f;
  std::vector<size_t> pixel_of_query;
  size_t next = 0;
  for_each_pixel_in_tiles([&](int x, int y) {
    const Hit<float>& hit = hits[next];
    const Ray<float>& ray = sets.primary[next++];
    if (!hit.found()) return;
    const dvec3 dir = glm::normalize(bench.view.pixel_dir(x, y));
    const dvec3 weights = clamped_barycentrics(dvec3(scene.vertex(hit.triangle, 0)) - bench.view.eye,
                                               dvec3(scene.vertex(hit.triangle, 1)) - bench.view.eye,
                                               dvec3(scene.vertex(hit.triangle, 2)) - bench.view.eye, dir);
    const Surface<double> exact = surface_at(scene, hit.triangle, weights.y, weights.z, dir);
    if (glm::dot(exact.side, bench.toward) > 0) {
      sets.shadow_all.push_back({leave(exact, bench.toward).origin, hit.triangle, exact.from_outside});
      pixel_of_query.push_back(index_of(x, y));
    }
    const Surface<float> surface = surface_at(scene, hit.triangle, hit.u, hit.v, ray.dir);
    const uvec3& n = scene.triangle_normals[hit.triangle];
    const bool flat = scene.normals[n.x] == scene.normals[n.y] && scene.normals[n.x] == scene.normals[n.z];
    const Scattered<float> out = scatter(glass, surface, ray.dir);
    (flat ? sets.reflected_flat : sets.reflected_curved).push_back(leave(surface, out.reflected_dir));
    if (surface.from_outside) sets.refracted.push_back(leave(surface, out.refracted_dir, false));
  });

  std::vector<uint8_t> occluded(sets.shadow_all.size());
  shadow_answers(buffer, sets.shadow_all, occluded);
  constexpr uint8_t kUnasked = 2;
  std::vector<uint8_t> answers(hits.size(), kUnasked);
  for (size_t i = 0; i < occluded.size(); ++i) answers[pixel_of_query[i]] = occluded[i];
  for (size_t i = 0; i < occluded.size(); ++i) {
    const int px = static_cast<int>(pixel_of_query[i] % kWidth_px),
              py = static_cast<int>(pixel_of_query[i] / kWidth_px);
    bool boundary = false;
    for (int y = std::max(py - kMarkRadius_px, 0); y <= std::min(py + kMarkRadius_px, kHeight_px - 1); ++y)
      for (int x = std::max(px - kMarkRadius_px, 0); x <= std::min(px + kMarkRadius_px, kWidth_px - 1); ++x)
        boundary |= answers[index_of(x, y)] == 1 - occluded[i];
    if (boundary) sets.shadow_marked.push_back(sets.shadow_all[i]);
  }
  return sets;
}

std::vector<Ray<float>> as_rays(const std::vector<ShadowQuery>& queries, const dvec3& toward) {
  std::vector<Ray<float>> rays;
  for (const ShadowQuery& query : queries) rays.push_back({vec3(query.origin), vec3(toward), 1e-4f});
  return rays;
}

}  // namespace hybridrt
