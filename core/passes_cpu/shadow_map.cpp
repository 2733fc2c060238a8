#include "core/passes_cpu/shadow_map.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/raster/clusters.h"
#include "core/trace/holes.h"

// clang-format off: the order matters
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/passes_cpu/shadow_map.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

#include "core/raster/lanes-inl.h"
// clang-format on

#ifndef HYBRIDRT_SHADOW_MAP_TILE
#define HYBRIDRT_SHADOW_MAP_TILE
namespace hybridrt {
namespace {

constexpr int kTile_px = 128;                           // its depths fit the second-level cache
constexpr int kTileStride = kTile_px + kLongestVector;  // vectors may reach over the right edge

/// A part of the map and its depths.
struct MapTile {
  TexelBox box;
  float* depth;
  float* at(int x, int y) const { return depth + static_cast<size_t>(y - box.y0) * kTileStride + (x - box.x0); }
};

/// A triangle within a tile, in single precision: planes from the centre of the box's first texel on.
struct TileTriangle {
  TexelBox box;
  float edge[3][3], depth[3];  ///< a, b, c
};

TileTriangle in_tile(const MapTriangle& t, const MapTile& tile) {
  TileTriangle in;
  in.box = {std::max(t.box.x0, tile.box.x0), std::max(t.box.y0, tile.box.y0), std::min(t.box.x1, tile.box.x1),
            std::min(t.box.y1, tile.box.y1)};
  const auto keep = [&](const MapPlane& plane, double more, float(&to)[3]) {
    to[0] = static_cast<float>(plane.a), to[1] = static_cast<float>(plane.b);
    to[2] = static_cast<float>(plane.at(in.box.x0 + 0.5, in.box.y0 + 0.5) + more);
  };
  for (int i = 0; i < 3; ++i) keep(t.edge[i], kReach_px, in.edge[i]);
  keep(t.depth, 0, in.depth);
  return in;
}

/// Texel by texel, as each asks the texture.
void draw_with_holes(const Scene& scene, const MapTriangle& t, uint32_t triangle, const MapTile& tile) {
  const TexelBox box = in_tile(t, tile).box;
  for (int row = box.y0; row <= box.y1; ++row)
    for (int column = box.x0; column <= box.x1; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      const dvec3 inside(t.edge[0].at(x, y), t.edge[1].at(x, y), t.edge[2].at(x, y));
      if (!(std::min({inside.x, inside.y, inside.z}) >= -kReach_px)) continue;
      const dvec3 weights = glm::max(inside, dvec3(0)) * dvec3(t.weight[0], t.weight[1], t.weight[2]);
      const double sum = weights.x + weights.y + weights.z;
      if (is_hole(*scene.textures, triangle, weights.y / sum, weights.z / sum)) continue;
      const auto here = static_cast<float>(std::max(t.nearest, std::min(t.farthest, t.depth.at(x, y))));
      float& depth = *tile.at(column, row);
      depth = std::min(depth, here);
    }
}

bool has_holes(const Scene& scene, uint32_t triangle) {
  return scene.has_holes() && scene.textures->has_holes(scene.textures->triangle_maps[triangle]);
}

}  // namespace
}  // namespace hybridrt
#endif

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// A row's texels are the lanes. Nothing is fused, and lanes count from the box's first texel: the same bits under
/// every instruction set.
void draw_triangle(const MapTriangle& t, const MapTile& tile) {
  const TileTriangle in = in_tile(t, tile);
  const Floats nearest = all(static_cast<float>(t.nearest)), farthest = all(static_cast<float>(t.farthest));
  const auto along = [](const float(&plane)[3], Floats x, float row) {
    return hn::Add(hn::Mul(all(plane[0]), x), all(row));
  };
  for (int y = in.box.y0; y <= in.box.y1; ++y) {
    const auto row_of = [&](const float(&plane)[3]) { return plane[1] * static_cast<float>(y - in.box.y0) + plane[2]; };
    const float row[] = {row_of(in.edge[0]), row_of(in.edge[1]), row_of(in.edge[2]), row_of(in.depth)};
    float* const depth = tile.at(in.box.x0, y);
    for (int i = 0; i <= in.box.x1 - in.box.x0; i += kLanes) {
      const Floats x = hn::Add(lane_numbers(), all(static_cast<float>(i)));
      const Floats inside =
          hn::Min(hn::Min(along(in.edge[0], x, row[0]), along(in.edge[1], x, row[1])), along(in.edge[2], x, row[2]));
      const Mask covered = hn::Ge(inside, hn::Zero(kFloats));
      if (hn::AllFalse(kFloats, covered)) continue;
      const Floats here = hn::Max(nearest, hn::Min(farthest, along(in.depth, x, row[3])));
      const Floats before = load(depth + i);
      store(depth + i, hn::IfThenElse(covered, hn::Min(here, before), before));
    }
  }
}

void draw_items(const Scene& scene, const MapProjection& map, std::span<const MapCorner> corners,
                std::span<const MapItem> items, const MapTile& tile) {
  for (const MapItem& item : items) {
    const auto t = triangle_on_map(scene, map, corners, item.triangle, item.box);
    if (!t) continue;
    if (has_holes(scene, item.triangle))
      draw_with_holes(scene, *t, item.triangle, tile);
    else
      draw_triangle(*t, tile);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridrt {

HWY_EXPORT(draw_items);

namespace {

int tiles_across(int size_px) { return (size_px + kTile_px - 1) / kTile_px; }

void place_corners(const Scene& scene, const MapProjection& map, ThreadPool& pool, std::vector<MapCorner>& corners) {
  corners.resize(scene.positions.size());
  parallel_for(pool, corners.size(), 8192, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) corners[i] = corner_on_map(map, scene.positions[i]);
  });
}

void bin_triangles(const Scene& scene, const MapProjection& map, ThreadPool& pool, ShadowMapMemory& memory) {
  const int across = tiles_across(map.size_px);
  memory.bins.resize(pool.size());
  for (auto& worker : memory.bins) {
    worker.resize(static_cast<size_t>(across) * across);
    for (std::vector<MapItem>& tile : worker) tile.clear();
  }
  constexpr size_t kChunk = 4096;
  const size_t count = scene.triangle_count();
  pool.run((count + kChunk - 1) / kChunk, [&](size_t chunk, int worker) {
    const auto end = static_cast<uint32_t>(std::min(count, (chunk + 1) * kChunk));
    for (auto triangle = static_cast<uint32_t>(chunk * kChunk); triangle < end; ++triangle) {
      const TexelBox box = box_on_map(scene, map, memory.corners, triangle);
      if (box.empty()) continue;
      for (int y = box.y0 / kTile_px; y <= box.y1 / kTile_px; ++y)
        for (int x = box.x0 / kTile_px; x <= box.x1 / kTile_px; ++x)
          memory.bins[worker][static_cast<size_t>(y) * across + x].push_back({triangle, box});
    }
  });
}

}  // namespace

void draw_shadow_map(const Scene& scene, const ShadowMapFit& fit, int size_px, ThreadPool& pool,
                     ShadowMapMemory& memory, std::span<float> depth) {
  HRT_CHECK_EQ(depth.size(), static_cast<size_t>(size_px) * size_px);
  const MapProjection map{fit.origin, fit.map_from_origin, size_px};
  place_corners(scene, map, pool, memory.corners);
  bin_triangles(scene, map, pool, memory);
  const int across = tiles_across(size_px);
  memory.tiles.resize(pool.size());
  pool.run(static_cast<size_t>(across) * across, [&](size_t number, int worker) {
    const int x0 = static_cast<int>(number) % across * kTile_px, y0 = static_cast<int>(number) / across * kTile_px;
    std::vector<float>& nearest = memory.tiles[worker];
    nearest.assign(static_cast<size_t>(kTile_px) * kTileStride, 1.0f);
    const MapTile tile{{x0, y0, std::min(x0 + kTile_px, size_px) - 1, std::min(y0 + kTile_px, size_px) - 1},
                       nearest.data()};
    for (const auto& bins : memory.bins)
      HWY_DYNAMIC_DISPATCH(draw_items)(scene, map, memory.corners, bins[number], tile);
    for (int y = tile.box.y0; y <= tile.box.y1; ++y)
      std::copy_n(tile.at(x0, y), tile.box.x1 - x0 + 1, &depth[static_cast<size_t>(y) * size_px + x0]);
  });
}

}  // namespace hybridrt
#endif  // HWY_ONCE
