#pragma once

#include <gtest/gtest.h>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace hybridrt {

/// Reproducible numbers: unlike those of std::uniform_real_distribution, the same with every standard library.
struct Random {
  std::mt19937 engine;
  explicit Random(uint32_t seed) : engine(seed) {}
  float unit() { return static_cast<float>(engine() >> 8) * 0x1p-24f; }
  float between(float lo, float hi) { return lo + (hi - lo) * unit(); }
  uint32_t below(uint32_t n) { return engine() % n; }
  vec3 in_cube(float lo, float hi) { return {between(lo, hi), between(lo, hi), between(lo, hi)}; }
  vec3 direction() {
    for (;;)
      if (const vec3 d = in_cube(-1, 1); glm::dot(d, d) > 0.01f && glm::dot(d, d) < 1) return glm::normalize(d);
  }
};

/// Scenes here have triangles only, which is what the tracers read.
void add_triangle(Scene& scene, const vec3& a, const vec3& b, const vec3& c);
Scene transformed(Scene scene, float scale, const vec3& offset);

Scene random_soup(uint32_t seed, int triangles, float triangle_size);
Scene regular_grid(int cells);                       ///< axis-aligned faces, many in common planes
Scene coplanar_field(uint32_t seed, int triangles);  ///< overlapping, all in z = 0.25
Scene slivers(uint32_t seed, int triangles);         ///< aspect about 1e6
Scene with_degenerates(uint32_t seed);               ///< random soup, a third zero-area
Scene with_duplicates(uint32_t seed);                ///< every triangle three times, at scattered indices
Scene closed_box();                                  ///< [0,1]^3, wound outward, sharing 8 vertices
Scene closed_sphere(int segments, int rings);        ///< unit, at 0, sharing vertices

struct NamedScene {
  std::string name;
  Scene scene;
};
inline void PrintTo(const NamedScene& scene, std::ostream* out) { *out << scene.name; }
inline std::string test_name(const testing::TestParamInfo<NamedScene>& scene) { return scene.param.name; }
std::vector<NamedScene> all_test_scenes();

/// Rays of all kinds across `bounds`: from inside, outside and far away; along axes, with one or two zero
/// components of either sign, from points on the bounds and on vertices, towards vertices, with bounded t.
std::vector<Ray<float>> assorted_rays(const Scene& scene, uint32_t seed, int count);

inline Ray<double> in_double(const Ray<float>& ray) {
  return {dvec3(ray.origin), dvec3(ray.dir), ray.t_min, ray.t_max};
}

/// A scene with this bounding box: eight triangles, one at each corner.
Scene boxed(const vec3& lo, const vec3& hi);

}  // namespace hybridrt
