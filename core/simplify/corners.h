#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace hybridrt {

/// Corner k of triangle t is 3 t + k: what a triangle has at a vertex, its position, normal, texture coordinates and
/// colour.
using Corner = uint32_t;

/// A triangle made of corners of a scene's triangles; material and maps are those of triangle `from`.
struct CornerTriangle {
  uint32_t from = 0;
  std::array<Corner, 3> corners{};
};

/// Triangle t of a scene as it is.
inline CornerTriangle as_it_is(uint32_t t) { return {t, {3 * t, 3 * t + 1, 3 * t + 2}}; }

/// Whether both corners shade alike where they meet: equal normals, texture coordinates and colours, by value, and
/// triangles of one material.
bool shade_alike(const Scene& scene, Corner a, Corner b);

/// A scene of these triangles, in their order, with what they use of the arrays of `scene` and all its materials;
/// arrays keep their order. Textures' texels are copied.
Scene scene_of_corners(const Scene& scene, const std::vector<CornerTriangle>& triangles);

}  // namespace hybridrt
