#pragma once

#include "core/scene/scene.h"

namespace hybridrt {

// A triangle's data lie anywhere in memory: they are fetched while others are worked on, first what names its corners,
// then the corners.

inline void prefetch_numbers(const Scene& scene, uint32_t triangle) {
  __builtin_prefetch(&scene.triangle_positions[triangle]);
  __builtin_prefetch(&scene.triangle_normals[triangle]);
  __builtin_prefetch(&scene.triangle_materials[triangle]);
}

inline void prefetch_corners(const Scene& scene, uint32_t triangle) {
  for (int k = 0; k < 3; ++k) {
    __builtin_prefetch(&scene.positions[scene.triangle_positions[triangle][k]]);
    __builtin_prefetch(&scene.normals[scene.triangle_normals[triangle][k]]);
  }
}

}  // namespace hybridrt
