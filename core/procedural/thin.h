#pragma once

#include <cstdint>
#include <optional>

#include "core/scene/scene.h"
#include "core/scene/scene_shot.h"

namespace hybridrt {

/// A scene that shadow maps fail on: grass, wires thinner than a pixel, a fence, a grating, with a few balls and rings
/// among them on wavy ground.
struct ThinOptions {
  int64_t triangles = 500'000;  ///< aimed at, kFewestTriangles to kMostTriangles; met within 5 %
  /// Absent: three balls are mirrors. Present: this percentage of the connected components (0 to 100; above
  /// 0 at least one; nested as it grows) are, and nothing else.
  std::optional<double> reflective_percent;

  static constexpr int64_t kFewestTriangles = 10'000, kMostTriangles = 20'000'000;
};

/// A garden 20 units square, y up, the ground around y = 0. All components are closed meshes with outward winding;
/// blades and posts begin slightly above the ground, so that they do not touch it. A pure function: same options, same
/// scene.
Scene make_thin(const ThinOptions& options);

/// Over the grass toward the fence, a low sun on the left.
SceneShot thin_shot();

}  // namespace hybridrt
