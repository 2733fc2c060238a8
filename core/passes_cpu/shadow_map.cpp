#include "core/passes_cpu/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/trace/holes.h"

namespace hybridrt {
namespace {

constexpr int kTile_px = 128;         // its depths fit the second-level cache
constexpr int kTestedByTexel_px = 8;  // rows up to this length are tested texel by texel

/// A part of the map: its depths in rows of kTile_px.
struct MapTile {
  TexelBox box;
  std::span<float> depth;
  float* row(int y) const { return &depth[static_cast<size_t>(y - box.y0) * kTile_px]; }
};

bool covers(const MapTriangle& t, double x, double y) {
  return t.edge[0].at(x, y) >= 0 && t.edge[1].at(x, y) >= 0 && t.edge[2].at(x, y) >= 0;
}

/// Narrows texels [first, last] of the row at `y` to those that the edges may leave.
void narrow_row(const MapTriangle& t, double y, int& first, int& last) {
  double lo = first, hi = last;
  for (const MapPlane& edge : t.edge) {
    const double rest = edge.b * y + edge.c;
    if (edge.a > 0) lo = std::max(lo, std::floor(-rest / edge.a - 0.5));
    if (edge.a < 0) hi = std::min(hi, std::ceil(-rest / edge.a - 0.5));
    if (edge.a == 0 && rest < 0) hi = lo - 1;
  }
  first = static_cast<int>(std::min<double>(lo, last + 1)), last = static_cast<int>(std::max<double>(hi, first - 1));
}

/// Whether the triangle has a hole at a place that it covers.
bool has_hole_at(const Scene& scene, const MapTriangle& t, uint32_t triangle, double x, double y) {
  const dvec3 weights(t.edge[0].at(x, y) * t.inverse_w[0], t.edge[1].at(x, y) * t.inverse_w[1],
                      t.edge[2].at(x, y) * t.inverse_w[2]);
  const double sum = weights.x + weights.y + weights.z;
  return sum > 0 && is_hole(*scene.textures, triangle, weights.y / sum, weights.z / sum);
}

void draw_triangle(const Scene& scene, const MapTriangle& t, uint32_t triangle, const MapTile& tile) {
  const bool holes = scene.has_holes() && scene.textures->has_holes(scene.textures->triangle_maps[triangle]);
  const int x0 = std::max(t.box.x0, tile.box.x0), x1 = std::min(t.box.x1, tile.box.x1);
  const int y0 = std::max(t.box.y0, tile.box.y0), y1 = std::min(t.box.y1, tile.box.y1);
  for (int row = y0; row <= y1; ++row) {
    const double y = row + 0.5;
    int first = x0, last = x1;
    if (last - first >= kTestedByTexel_px) narrow_row(t, y, first, last);
    while (first <= last && !covers(t, first + 0.5, y)) ++first;
    while (first <= last && !covers(t, last + 0.5, y)) --last;  // what lies between two covered texels is covered
    const double row_depth = t.depth + t.slope_y * (y - t.y_px);
    float* const depth = tile.row(row) - tile.box.x0;
    for (int x = first; x <= last; ++x) {
      if (holes && has_hole_at(scene, t, triangle, x + 0.5, y)) continue;
      const double exact = row_depth + t.slope_x * (x + 0.5 - t.x_px);
      const auto here = static_cast<float>(std::max(t.least_depth, std::min(t.most_depth, exact)));
      depth[x] = here < depth[x] ? here : depth[x];
    }
  }
}

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
    for (std::vector<uint32_t>& tile : worker) tile.clear();
  }
  constexpr size_t kChunk = 4096;
  const size_t count = scene.triangle_count();
  pool.run((count + kChunk - 1) / kChunk, [&](size_t chunk, int worker) {
    const auto end = static_cast<uint32_t>(std::min(count, (chunk + 1) * kChunk));
    for (auto triangle = static_cast<uint32_t>(chunk * kChunk); triangle < end; ++triangle) {
      const TexelBox box = box_on_map(scene, map, memory.corners, triangle);
      if (box.x0 > box.x1 || box.y0 > box.y1) continue;
      for (int y = box.y0 / kTile_px; y <= box.y1 / kTile_px; ++y)
        for (int x = box.x0 / kTile_px; x <= box.x1 / kTile_px; ++x)
          memory.bins[worker][static_cast<size_t>(y) * across + x].push_back(triangle);
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
    nearest.assign(static_cast<size_t>(kTile_px) * kTile_px, 1.0f);
    const MapTile tile{{x0, y0, std::min(x0 + kTile_px, size_px) - 1, std::min(y0 + kTile_px, size_px) - 1}, nearest};
    for (const auto& bins : memory.bins)
      for (const uint32_t triangle : bins[number])
        if (const auto t = triangle_on_map(scene, map, memory.corners, triangle))
          draw_triangle(scene, *t, triangle, tile);
    for (int y = tile.box.y0; y <= tile.box.y1; ++y)
      std::copy_n(tile.row(y), tile.box.x1 - x0 + 1, &depth[static_cast<size_t>(y) * size_px + x0]);
  });
}

}  // namespace hybridrt
