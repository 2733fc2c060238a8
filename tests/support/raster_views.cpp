#include "tests/support/raster_views.h"

#include <array>
#include <cmath>

namespace hybridrt {

View random_view(const Scene& scene, Random& random) {
  static constexpr int kSizes[][2] = {{64, 48}, {128, 96}, {300, 200}, {1, 1}, {700, 3}, {5, 600}, {260, 130}};
  const Aabb box = scene.bounds.empty() ? Aabb{vec3(0), vec3(1)} : scene.bounds;
  const vec3 extent = glm::max(box.extent(), vec3(1e-20f));
  const auto inside = [&] { return box.lo + extent * random.in_cube(0, 1); };
  Camera camera;
  camera.target_world = dvec3(inside());
  switch (random.below(6)) {
    case 0: camera.eye_world = dvec3(inside()); break;
    case 1:  // on a triangle, or a hair off it
      if (scene.triangle_count() > 0) {
        const uint32_t t = random.below(static_cast<uint32_t>(scene.triangle_count()));
        const float u = random.unit(), v = (1 - u) * random.unit();
        camera.eye_world = dvec3(scene.vertex(t, 0)) * double(1 - u - v) + dvec3(scene.vertex(t, 1)) * double(u) +
                           dvec3(scene.vertex(t, 2)) * double(v);
        if (random.below(2)) camera.eye_world += 1e-6 * dvec3(extent * random.in_cube(-1, 1));
        break;
      }
      [[fallthrough]];
    case 2: camera.eye_world = dvec3(box.center()) + 30.0 * dvec3(extent) * dvec3(random.direction()); break;
    case 3:  // along an axis, from a plane of vertices
      camera.eye_world = dvec3(box.center());
      camera.eye_world[random.below(3)] += 1.5 * double(glm::length(extent));
      camera.target_world = dvec3(box.center());
      break;
    default: camera.eye_world = dvec3(box.center()) + 1.2 * dvec3(extent) * dvec3(random.direction());
  }
  if (camera.eye_world == camera.target_world) camera.target_world += dvec3(extent) * 0.5;
  static constexpr double kFields_deg[] = {45, 45, 60, 90, 1, 0.02, 150, 179};
  camera.fov_y_rad = kFields_deg[random.below(8)] * kPi / 180;
  const auto& size = kSizes[random.below(7)];
  View view = make_view(camera, dvec3(0), size[0], size[1]);
  if (random.below(4) == 0) view.sample_px = dvec2(random.between(-0.5f, 0.5f), random.between(-0.5f, 0.5f));
  if (random.below(4) == 0 && size[0] > 8 && size[1] > 8) {
    const int x = static_cast<int>(random.below(size[0] - 4)), y = static_cast<int>(random.below(size[1] - 4));
    const dvec2 sample = view.sample_px;
    view = part_of(view, x, y, 1 + static_cast<int>(random.below(size[0] - x)),
                   1 + static_cast<int>(random.below(size[1] - y)));
    view.sample_px = sample;
  }
  return view;
}

std::vector<uint32_t> reference_ids(const RayCaster<double>& caster, const View& view, ThreadPool& pool) {
  std::vector<uint32_t> ids(static_cast<size_t>(view.width_px) * view.height_px);
  pool.run(view.height_px, [&](size_t row, int) {
    std::vector<Ray<double>> rays(view.width_px);
    std::vector<Hit<double>> hits(rays.size());
    for (int x = 0; x < view.width_px; ++x)
      rays[x] = {view.eye, glm::normalize(view.pixel_dir(x, static_cast<int>(row)))};
    caster.closest_hits(rays, hits);
    for (size_t x = 0; x < hits.size(); ++x) ids[row * view.width_px + x] = hits[x].triangle;
  });
  return ids;
}

std::vector<uint32_t> rasterized_ids(const Scene& scene, const Clusters& clusters, const View& view, ThreadPool& pool) {
  std::vector<uint32_t> ids(static_cast<size_t>(view.width_px) * view.height_px);
  RasterMemory memory;
  rasterize_ids(scene, clusters, view, pool, memory, ids);
  return ids;
}

SampledPixels sample_some_pixels(const Scene& scene, const Clusters& clusters, View view, ThreadPool& pool,
                                 Random& random) {
  SampledPixels sampled;
  const bool on_grid = random.below(2) == 0;
  const auto place = [&] { return on_grid ? 0.25 * random.below(5) - 0.5 : double{random.between(-0.5f, 0.5f)}; };
  view.sample_px = dvec2(0);
  for (uint32_t i = 1 + random.below(20); i > 0; --i) {
    sampled.views.push_back(view);
    sampled.views.back().sample_px = dvec2(place(), place());
  }
  const float share = std::array{0.02f, 0.5f, 1.0f}[random.below(3)];
  RasterMemory memory;
  bin_clusters(scene, clusters, view, pool, memory.bins, kSampleSpread_px);
  memory.tiles.resize(1);
  for (int tile = 0; tile < memory.bins.tile_count(); ++tile) {
    const int x0 = tile % memory.bins.tiles_x * kTileWidth_px, y0 = tile / memory.bins.tiles_x * kTileHeight_px;
    const size_t first = sampled.pixels.size();
    for (int y = y0; y < std::min(y0 + kTileHeight_px, view.height_px); ++y)
      for (int x = x0; x < std::min(x0 + kTileWidth_px, view.width_px); ++x)
        if (random.unit() <= share) sampled.pixels.push_back({x, y});
    sampled.triangles.resize(sampled.pixels.size() * sampled.views.size());
    memory.tiles[0].find_samples(scene, clusters, memory.bins, tile, sampled.views,
                                 std::span(sampled.pixels).subspan(first),
                                 std::span(sampled.triangles).subspan(first * sampled.views.size()));
  }
  return sampled;
}

int wrong_samples(const RayCaster<double>& caster, const SampledPixels& sampled, ThreadPool& pool) {
  int wrong = 0;
  for (size_t s = 0; s < sampled.views.size(); ++s) {
    const View& view = sampled.views[s];
    const std::vector<uint32_t> truth = reference_ids(caster, view, pool);
    for (size_t i = 0; i < sampled.pixels.size(); ++i) {
      const PixelAt at = sampled.pixels[i];
      wrong +=
          sampled.triangles[i * sampled.views.size() + s] != truth[static_cast<size_t>(at.y) * view.width_px + at.x];
    }
  }
  return wrong;
}

Scene doubled_faces(uint32_t seed) {
  Scene scene = random_soup(seed, 300, 0.4f);
  Random random(seed);
  const std::vector<uvec3> once = scene.triangle_positions;
  for (size_t i = 0; i < once.size(); ++i) {
    const uvec3 t = once[(i * 7) % once.size()];
    const uint32_t first = random.below(3);
    scene.triangle_positions.push_back({t[first], t[(first + 2) % 3], t[(first + 1) % 3]});
  }
  return scene;
}

Scene sheet_on_centers(int cells) {
  Scene scene;
  const auto at = [cells](int x, int y, float z) {
    return vec3(static_cast<float>(x - cells / 2), static_cast<float>(y - cells / 2), z);
  };
  for (int x = 0; x < cells; ++x)
    for (int y = 0; y < cells; ++y) {
      if ((x + 3 * y) % 5 == 0) continue;
      add_triangle(scene, at(x, y, 0), at(x + 1, y, 0), at(x + 1, y + 1, 0));
      add_triangle(scene, at(x, y, 0), at(x + 1, y + 1, 0), at(x, y + 1, 0));
      if (x % 2 == 0) add_triangle(scene, at(x, y, -1), at(x + 2, y, 0), at(x, y + 2, 1));
    }
  scene.bounds = compute_bounds(scene);
  return scene;
}

View sheet_view(int cells, double height) {
  Camera camera;
  camera.eye_world = dvec3(0.5 * (cells % 2), 0.5 * (cells % 2), height);
  camera.target_world = camera.eye_world - dvec3(0, 0, height);
  camera.fov_y_rad = 2 * std::atan(0.5 * cells / height);
  View view = make_view(camera, dvec3(0), 4 * cells + 1, 4 * cells);
  view.tan_half_width = (4.0 * cells + 1) / (4.0 * cells) * view.tan_half_height;
  view.sample_px = dvec2(0, 0.5);
  return view;
}

View sheet_view_beside(int cells, Random& random) {
  View view = sheet_view(cells, std::pow(10.0, random.between(0.3f, 3)));
  const double pixel = 0.25 * std::pow(10.0, random.between(-9, -3));  // a cell has four
  view.eye += dvec3(pixel * random.between(-1, 1), pixel * random.between(-1, 1), 0);
  return view;
}

Scene nearly_one_plane(uint32_t seed) {
  Random random(seed);
  Scene scene;
  const auto corner = [&](const vec3& p, float size) {
    vec3 q = p + size * random.in_cube(-1, 1);
    q.z = 0.25f + 3e-8f * static_cast<float>(random.below(40));
    return q;
  };
  for (int i = 0; i < 600; ++i) {
    const vec3 p = random.in_cube(0, 1);
    const float size = std::pow(10.0f, random.between(-1.5f, 0));
    add_triangle(scene, corner(p, size), corner(p, size), corner(p, size));
  }
  scene.bounds = compute_bounds(scene);
  return scene;
}

View view_of_plane(Random& random) {
  Camera camera;
  camera.eye_world = dvec3(random.in_cube(-1, 2)) + dvec3(0, 0, 1.5);
  camera.target_world = dvec3(random.unit(), random.unit(), 0.25);
  camera.fov_y_rad = 0.6;
  return make_view(camera, dvec3(0), 200, 150);
}

Scene huge_and_small(uint32_t seed) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < 1500; ++i) {
    const float size = std::pow(10.0f, random.between(-2, 6));
    add_triangle(scene, size * random.in_cube(-1, 1), size * random.in_cube(-1, 1), size * random.in_cube(-1, 1));
  }
  scene.bounds = compute_bounds(scene);
  return scene;
}

}  // namespace hybridrt
