#pragma once

#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/passes/shadow_map_fit.h"
#include "core/raster/map_triangle.h"

namespace hybridrt {

/// A triangle that may cover texels of a tile of the map.
struct MapItem {
  uint32_t triangle;
  TexelBox box;  ///< of the map
};

/// What pass 1 keeps from map to map, to use its memory again.
struct ShadowMapMemory {
  std::vector<MapCorner> corners;                       ///< of the scene's positions
  std::vector<std::vector<std::vector<MapItem>>> bins;  ///< per thread and tile of the map
  std::vector<std::vector<float>> tiles;                ///< per thread the tile at hand
};

/// Pass 1 on the CPU (paper, section 3.4): the depth of the nearest surface that the light sees, sampled at the texels'
/// centres as the GL form does, both sides of every triangle, through holes. `depth`: size_px squared elements, rows
/// from v = 0 on: z / w of the fit, 1 where nothing is. Tiles of the map are shared out over the threads; the nearest
/// depth does not depend on the order, so the map is the same for any number of them.
void draw_shadow_map(const Scene& scene, const ShadowMapFit& fit, int size_px, ThreadPool& pool,
                     ShadowMapMemory& memory, std::span<float> depth);

}  // namespace hybridrt
