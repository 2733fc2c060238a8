#pragma once

#include <cstdint>

#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// In Scene::triangle_normals while loading: this corner has no normal yet.
inline constexpr uint32_t kNoNormal = 0xFFFFFFFFu;

/// Gives every corner that is kNoNormal a unit normal, appended to scene.normals; corners of one vertex with the same
/// normal share it. A corner's normal is the average of the face normals around its vertex, weighted by the angle of
/// each face there, over the faces within 45 degrees of the corner's own: smooth surfaces become smooth and boxes stay
/// sharp. Vertices in the same place are one (weld.h), whatever their indices. Smoothing groups are ignored. Where more
/// than 256 faces meet (a cone's tip) each corner keeps its face's normal, as comparing all pairs would take too long.
///
/// Counts them in scene.built_normal_corners. Requires triangles of non-zero area. The result does not depend on the
/// number of threads. Source: Thuermer and Wuethrich, Computing Vertex Normals from Polygonal Facets, 1998.
void rebuild_missing_normals(Scene& scene, ThreadPool& pool);

}  // namespace hybridrt
