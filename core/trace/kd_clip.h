#pragma once

#include <optional>

#include "core/base/math.h"
#include "core/scene/scene.h"
#include "core/trace/kd_split.h"

namespace hybridrt {

/// Bounds of the part of a triangle that lies in `box`, rounded outwards to float and never larger than `box`, or
/// nothing if the triangle is farther than `margin` from the box. Source: Sutherland and Hodgman, "Reentrant polygon
/// clipping", 1974.
std::optional<Aabb> clip_triangle(const vec3& v0, const vec3& v1, const vec3& v2, const Aabb& box, double margin);

/// Hands each half of `ref`, clipped to its child cell, to `left` or `right`; most references lie on one
/// side only and go there unchanged.
template <typename Left, typename Right>
void split_reference(const Scene& scene, double margin, const KdReference& ref, const KdSplit& split,
                     const Aabb& left_box, const Aabb& right_box, const Left& left, const Right& right) {
  const KdSide side = side_of(ref, split);
  if (side == KdSide::left) return left(ref);
  if (side == KdSide::right) return right(ref);
  const vec3 a = scene.vertex(ref.triangle, 0), b = scene.vertex(ref.triangle, 1), c = scene.vertex(ref.triangle, 2);
  const auto clip = [&](const Aabb& cell) {
    return clip_triangle(a, b, c, {glm::max(cell.lo, ref.box.lo), glm::min(cell.hi, ref.box.hi)}, margin);
  };
  if (const auto box = clip(left_box)) left(KdReference{*box, ref.triangle});
  if (const auto box = clip(right_box)) right(KdReference{*box, ref.triangle});
}

}  // namespace hybridrt
