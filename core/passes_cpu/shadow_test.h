#pragma once

#include <span>

#include "core/base/parallel.h"
#include "core/passes/shadow_map_fit.h"
#include "core/scene/view.h"

namespace hybridrt {

/// What the shadow test of pass 2 reads.
struct ShadowTest {
  const Scene& scene;
  const View& view;
  const dvec3& to_light;    ///< unit
  const ShadowMapFit& fit;  ///< with which the map was drawn
  int map_px;
  std::span<const float> map;     ///< from draw_shadow_map()
  std::span<const uint32_t> ids;  ///< triangle seen, or kNoTriangle; one per pixel, rows from the top
};

/// Pass 2, second step: the shadow-map test, once per pixel that sees a triangle, in single precision and by the text
/// of the GL form (shaders/shadow_test.comp). `mask`: HRT_MASK_LIT, 0 or HRT_MASK_NO_RECEIVER per pixel.
void test_shadows(const ShadowTest& test, ThreadPool& pool, std::span<uint8_t> mask);

}  // namespace hybridrt
