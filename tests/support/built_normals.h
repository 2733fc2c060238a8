#pragma once

#include "core/mesh/normals.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// The scene with normals as the loaders build them.
inline Scene with_built_normals(Scene scene) {
  ThreadPool pool(1);
  scene.normals.clear();
  scene.triangle_normals.assign(scene.triangle_count(), uvec3(kNoNormal));
  rebuild_missing_normals(scene, pool);
  scene.bounds = compute_bounds(scene);
  validate(scene);
  return scene;
}

}  // namespace hybridrt
