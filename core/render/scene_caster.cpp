#include "core/render/scene_caster.h"

#include "core/base/timing.h"
#include "core/trace/embree_caster.h"
#include "core/trace/kd_caster.h"

namespace hybridrt {

SceneCaster<float> make_scene_caster(const Scene& scene, Accel accel, ThreadPool& pool) {
  const Stopwatch building;
  SceneCaster<float> made;
  if (accel == Accel::embree) {
    made.caster = make_embree_caster(scene, pool.size());
  } else {
    made.tree = std::make_shared<const KdTree>(build_kd_tree(scene, pool));
    made.caster = make_kd_caster(*made.tree, LeafKernel::simd);
  }
  made.build_ms = building.elapsed_ms();
  return made;
}

SceneCaster<double> make_reference_scene_caster(const Scene& scene, ThreadPool& pool) {
  const Stopwatch building;
  SceneCaster<double> made;
  made.tree = std::make_shared<const KdTree>(build_kd_tree(scene, pool));
  made.caster = make_reference_caster(*made.tree);
  made.build_ms = building.elapsed_ms();
  return made;
}

}  // namespace hybridrt
