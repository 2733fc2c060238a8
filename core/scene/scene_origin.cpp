#include "core/scene/scene_origin.h"

#include <cmath>

namespace hybridrt {
namespace {

constexpr double kFarFromOrigin = 16;  // times the scene's size

}  // namespace

dvec3 choose_scene_origin(const WorldBox& box) {
  const double size = box.size();
  const dvec3 farthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  const double reach = glm::max(farthest.x, glm::max(farthest.y, farthest.z));
  if (size == 0 || reach <= kFarFromOrigin * size) return dvec3(0);  // a point has no area and is refused later
  const double grid = std::exp2(std::floor(std::log2(size)));
  return glm::round((box.lo + (box.hi - box.lo) / 2.0) / grid) * grid;
}

}  // namespace hybridrt
