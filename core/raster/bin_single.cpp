#include "core/raster/bin_single.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace hybridrt {
namespace {

constexpr float kAnyDepth = std::numeric_limits<float>::max();

/// A triangle's corners along the camera's axes.
struct CameraTriangle {
  double x[3], y[3], z[3];
  double reach = 0;  ///< the largest distance of a corner, summed over the axes

  CameraTriangle(const Scene& scene, const Screen& screen, uint32_t triangle) {
    for (int k = 0; k < 3; ++k) {
      const dvec3 d = dvec3(scene.vertex(triangle, k)) - screen.eye;
      x[k] = glm::dot(d, screen.right), y[k] = glm::dot(d, screen.up), z[k] = glm::dot(d, screen.forward);
      reach = std::max(reach, std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    }
  }
};

/// Whether all corners lie outside one side of the picture.
bool is_outside(const CameraTriangle& t, const Screen& screen) {
  const double beyond = 0.5 + screen.spread_px;  // the outer pixels' centres
  const double left = (-beyond - screen.middle_x) / screen.scale_x;
  const double right = (screen.width_px - 1 + beyond - screen.middle_x) / screen.scale_x;
  const double bottom = (screen.middle_y - screen.height_px + 1 - beyond) / screen.scale_y;
  const double top = (screen.middle_y + beyond) / screen.scale_y;
  const double rounding =
      1e-12 * t.reach * (1 + std::max({std::abs(left), std::abs(right), std::abs(bottom), std::abs(top)}));
  const auto all_over = [&](const auto& value) {
    return value(0) > rounding && value(1) > rounding && value(2) > rounding;
  };
  return all_over([&](int k) { return -t.z[k]; }) || all_over([&](int k) { return t.x[k] - right * t.z[k]; }) ||
         all_over([&](int k) { return left * t.z[k] - t.x[k]; }) ||
         all_over([&](int k) { return t.y[k] - top * t.z[k]; }) ||
         all_over([&](int k) { return bottom * t.z[k] - t.y[k]; });
}

/// The pixels that the triangle may touch, and its nearest depth; nothing if there are none.
std::optional<BinItem> place_of(const CameraTriangle& t, const Screen& screen) {
  BinItem item{
      kAnyDepth, 0, 0, 0, 0, static_cast<uint16_t>(screen.width_px - 1), static_cast<uint16_t>(screen.height_px - 1)};
  const double nearest = std::min({t.z[0], t.z[1], t.z[2]});
  if (nearest <= 1e-6 * t.reach) return item;  // it reaches behind the eye, or nearly
  double x0 = 1e30, y0 = 1e30, x1 = -1e30, y1 = -1e30;
  for (int k = 0; k < 3; ++k) {
    const double x = screen.middle_x + screen.scale_x * t.x[k] / t.z[k];
    const double y = screen.middle_y - screen.scale_y * t.y[k] / t.z[k];
    x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  const double margin_px = 1e-2 + screen.spread_px;
  x0 = std::max(0.0, std::ceil(x0 - margin_px)), x1 = std::min(screen.width_px - 1.0, std::floor(x1 + margin_px));
  y0 = std::max(0.0, std::ceil(y0 - margin_px)), y1 = std::min(screen.height_px - 1.0, std::floor(y1 + margin_px));
  if (!(x0 <= x1 && y0 <= y1)) return std::nullopt;
  item.nearest = static_cast<float>(std::min<double>(screen.unit / nearest * (1 + 1e-6), kAnyDepth));
  item.x0 = static_cast<uint16_t>(x0), item.x1 = static_cast<uint16_t>(x1);
  item.y0 = static_cast<uint16_t>(y0), item.y1 = static_cast<uint16_t>(y1);
  return item;
}

}  // namespace

void add_to_tiles(FrameBins& bins, int worker, const BinItem& item) {
  WorkerBins& own = bins.workers[worker];
  for (int j = item.y0 / kTileHeight_px; j <= item.y1 / kTileHeight_px; ++j)
    for (int i = item.x0 / kTileWidth_px; i <= item.x1 / kTileWidth_px; ++i)
      own.tiles[static_cast<size_t>(j) * bins.tiles_x + i].push_back(item);
}

void bin_triangles(const Scene& scene, const Clusters& clusters, size_t cluster, const Screen& screen, int worker,
                   FrameBins& bins) {
  WorkerBins& own = bins.workers[worker];
  const Cluster& head = clusters.clusters[cluster];
  const uint32_t* triangles = clusters.triangles(head);
  const int spread = static_cast<int>(std::ceil(screen.spread_px));
  for (int n = 0; n < head.triangle_count; ++n) {
    const CameraTriangle seen(scene, screen, triangles[n]);
    if (is_outside(seen, screen)) continue;
    std::optional<BinItem> item = place_of(seen, screen);
    if (!item) continue;
    const HomogeneousTriangle made = make_homogeneous(scene, screen, triangles[n], item->nearest);
    item->index = static_cast<uint32_t>(own.single.size());
    item->worker = worker;
    own.single.push_back(made);
    for (int j = item->y0 / kTileHeight_px; j <= item->y1 / kTileHeight_px; ++j)
      for (int i = item->x0 / kTileWidth_px; i <= item->x1 / kTileWidth_px; ++i) {
        const PixelBox tile{i * kTileWidth_px - spread, j * kTileHeight_px - spread,
                            (i + 1) * kTileWidth_px - 1 + spread, (j + 1) * kTileHeight_px - 1 + spread};
        if (!misses_box(made, tile)) own.tiles[static_cast<size_t>(j) * bins.tiles_x + i].push_back(*item);
      }
  }
}

}  // namespace hybridrt
