#include "tests/support/trace_scenes.h"

#include <algorithm>
#include <cmath>

namespace hybridrt {
namespace {

Scene finish(Scene scene) {
  scene.bounds = compute_bounds(scene);
  return scene;
}

void add_quad(Scene& scene, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  scene.triangle_positions.push_back({a, b, c});
  scene.triangle_positions.push_back({a, c, d});
}

}  // namespace

void add_triangle(Scene& scene, const vec3& a, const vec3& b, const vec3& c) {
  const uint32_t first = static_cast<uint32_t>(scene.positions.size());
  scene.positions.insert(scene.positions.end(), {a, b, c});
  scene.triangle_positions.push_back({first, first + 1, first + 2});
}

Scene transformed(Scene scene, float scale, const vec3& offset) {
  for (vec3& p : scene.positions) p = p * scale + offset;
  return finish(std::move(scene));
}

Scene random_soup(uint32_t seed, int triangles, float triangle_size) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < triangles; ++i) {
    const vec3 p = random.in_cube(0, 1), s(triangle_size);
    add_triangle(scene, p, p + s * random.in_cube(-1, 1), p + s * random.in_cube(-1, 1));
  }
  return finish(std::move(scene));
}

Scene regular_grid(int cells) {
  Scene scene;
  for (int axis = 0; axis < 3; ++axis)
    for (int layer = 0; layer <= cells; ++layer)
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          const auto at = [&](int di, int dj) {
            vec3 p;
            p[axis] = static_cast<float>(layer);
            p[(axis + 1) % 3] = static_cast<float>(i + di);
            p[(axis + 2) % 3] = static_cast<float>(j + dj);
            return p / static_cast<float>(cells);
          };
          if ((i + 2 * j + layer) % 3 == 0) continue;  // holes to look through
          add_triangle(scene, at(0, 0), at(1, 0), at(1, 1));
          add_triangle(scene, at(0, 0), at(1, 1), at(0, 1));
        }
  return finish(std::move(scene));
}

Scene coplanar_field(uint32_t seed, int triangles) {
  Scene scene = random_soup(seed, triangles, 0.2f);
  for (vec3& p : scene.positions) p.z = 0.25f;
  return finish(std::move(scene));
}

Scene slivers(uint32_t seed, int triangles) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < triangles; ++i) {
    const vec3 p = random.in_cube(0, 1), q = random.in_cube(0, 1);
    add_triangle(scene, p, q, p + random.unit() * (q - p) + 1e-6f * random.direction());
  }
  return finish(std::move(scene));
}

Scene with_degenerates(uint32_t seed) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < 900; ++i) {
    const vec3 p = random.in_cube(0, 1), e = 0.2f * random.in_cube(-1, 1), f = 0.2f * random.in_cube(-1, 1);
    const vec3 grid = glm::floor(p * 16.0f) / 16.0f;
    switch (i % 9) {
      case 0: add_triangle(scene, p, p, p); break;
      case 1: add_triangle(scene, p, p + e, p + e); break;
      case 2: add_triangle(scene, grid, grid + vec3(0.125f, 0.25f, 0), grid + vec3(0.25f, 0.5f, 0)); break;
      default: add_triangle(scene, p, p + e, p + f);
    }
  }
  return finish(std::move(scene));
}

Scene with_duplicates(uint32_t seed) {
  Scene scene = random_soup(seed, 300, 0.3f);
  const std::vector<uvec3> once = scene.triangle_positions;
  for (size_t i = 0; i < once.size(); ++i) scene.triangle_positions.push_back(once[(i * 7) % once.size()]);
  for (size_t i = 0; i < once.size(); ++i) scene.triangle_positions.push_back(once[(i * 11) % once.size()]);
  return scene;
}

Scene closed_box() {
  Scene scene;
  for (int i = 0; i < 8; ++i) scene.positions.push_back(vec3(i & 1, i >> 1 & 1, i >> 2 & 1));
  add_quad(scene, 0, 2, 3, 1), add_quad(scene, 4, 5, 7, 6), add_quad(scene, 0, 1, 5, 4);
  add_quad(scene, 2, 6, 7, 3), add_quad(scene, 0, 4, 6, 2), add_quad(scene, 1, 3, 7, 5);
  return finish(std::move(scene));
}

Scene closed_sphere(int segments, int rings) {
  Scene scene;
  scene.positions = {{0, 0, 1}, {0, 0, -1}};
  for (int ring = 1; ring < rings; ++ring)
    for (int segment = 0; segment < segments; ++segment) {
      const double theta = kPi * ring / rings, phi = 2 * kPi * segment / segments;
      scene.positions.push_back(
          vec3(dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta))));
    }
  const auto at = [&](int ring, int segment) {
    return static_cast<uint32_t>(2 + (ring - 1) * segments + segment % segments);
  };
  for (int segment = 0; segment < segments; ++segment) {
    scene.triangle_positions.push_back({0, at(1, segment), at(1, segment + 1)});
    for (int ring = 1; ring + 1 < rings; ++ring)
      add_quad(scene, at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1), at(ring, segment + 1));
    scene.triangle_positions.push_back({1, at(rings - 1, segment + 1), at(rings - 1, segment)});
  }
  return finish(std::move(scene));
}

std::vector<NamedScene> all_test_scenes() {
  std::vector<NamedScene> scenes = {
      {"SoupOfSmallTriangles", random_soup(1, 2000, 0.05f)},
      {"SoupOfLargeTriangles", random_soup(2, 300, 1.0f)},
      {"RegularGrid", regular_grid(8)},
      {"Coplanar", coplanar_field(3, 300)},
      {"Slivers", slivers(4, 400)},
      {"Degenerate", with_degenerates(5)},
      {"Duplicates", with_duplicates(6)},
      {"Box", closed_box()},
      {"Sphere", closed_sphere(32, 16)},
      {"SingleTriangle", random_soup(7, 1, 1.0f)},
      {"Empty", Scene{}},
  };
  scenes.push_back({"Tiny", transformed(random_soup(8, 500, 0.2f), 1e-12f, vec3(0))});
  scenes.push_back({"Huge", transformed(random_soup(9, 500, 0.2f), 1e12f, vec3(-3e11f))});
  scenes.push_back({"OffCentre", transformed(random_soup(10, 500, 0.2f), 1.0f, vec3(1000, -2000, 500))});
  return scenes;
}

std::vector<Ray<float>> assorted_rays(const Scene& scene, uint32_t seed, int count) {
  Random random(seed);
  const Aabb box = scene.positions.empty() ? Aabb{vec3(0), vec3(1)} : scene.bounds;
  const vec3 extent = box.extent();
  const float size = std::max({extent.x, extent.y, extent.z, std::numeric_limits<float>::min()});
  const auto some_vertex = [&] {
    return scene.positions.empty() ? vec3(0.5f)
                                   : scene.positions[random.below(static_cast<uint32_t>(scene.positions.size()))];
  };
  std::vector<Ray<float>> rays;
  for (int i = 0; i < count; ++i) {
    Ray<float> ray;
    switch (i % 4) {
      case 0: ray.origin = box.lo + extent * random.in_cube(0, 1); break;
      case 1: ray.origin = box.center() + size * random.in_cube(-3, 3); break;
      case 2: ray.origin = some_vertex(); break;
      case 3:
        ray.origin = box.lo + extent * random.in_cube(0, 1);
        ray.origin[static_cast<int>(random.below(3))] = random.below(2) ? box.lo.x : box.hi.y;
        break;
    }
    switch (i / 4 % 5) {
      case 0: ray.dir = random.direction(); break;
      case 1: ray.dir = random.direction() * random.between(0.1f, 10); break;
      case 2:
        ray.dir = vec3(0);
        ray.dir[static_cast<int>(random.below(3))] = random.below(2) ? 1.0f : -1.0f;
        if (random.below(2)) ray.dir *= -1.0f;  // makes the zeros negative
        break;
      case 3:
        ray.dir = random.direction();
        ray.dir[static_cast<int>(random.below(3))] = random.below(2) ? 0.0f : -0.0f;
        break;
      case 4: ray.dir = (some_vertex() - ray.origin) / size; break;
    }
    if (i / 20 % 3 == 1) ray.t_max = size * random.unit();
    if (i / 20 % 3 == 2) ray.t_min = 0.3f * size * random.unit();
    rays.push_back(ray);
  }
  return rays;
}

Scene boxed(const vec3& lo, const vec3& hi) {
  Scene scene;
  const auto corner = [&](int i) { return vec3(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z); };
  for (int i = 0; i < 8; ++i) add_triangle(scene, corner(i), corner(i ^ 1), corner(i ^ 2));
  scene.bounds = compute_bounds(scene);
  return scene;
}

}  // namespace hybridrt
