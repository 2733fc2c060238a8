#pragma once

#include <memory>

#include "core/base/parallel.h"
#include "core/render/settings.h"
#include "core/trace/kd_tree.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// A caster, its tree, and what building them took. Both are read-only, so copies share them.
template <typename Real>
struct SceneCaster {
  std::shared_ptr<const KdTree> tree;  ///< null if the caster holds its own
  std::shared_ptr<const RayCaster<Real>> caster;
  double build_ms = 0;
};

SceneCaster<float> make_scene_caster(const Scene& scene, Accel accel, ThreadPool& pool);

/// Double precision, for the reference method.
SceneCaster<double> make_reference_scene_caster(const Scene& scene, ThreadPool& pool);

}  // namespace hybridrt
