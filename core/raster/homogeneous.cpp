#include "core/raster/homogeneous.h"

#include <algorithm>
#include <cmath>

namespace hybridrt {
namespace {

constexpr double kFloatRounding = 0x1p-24;

}  // namespace

HomogeneousTriangle make_homogeneous(const Scene& scene, const Screen& screen, uint32_t triangle, float nearest) {
  HomogeneousTriangle made;
  made.triangle = triangle;
  made.nearest = nearest;
  made.has_holes = scene.has_holes(triangle);
  dvec3 corner[3], normal[3];
  double distance[3];
  for (int k = 0; k < 3; ++k) {
    corner[k] = dvec3(scene.vertex(triangle, k)) - screen.eye;
    distance[k] = glm::length(corner[k]);
  }
  // Each product of two corners is rounded by about 2^-52 of its size, and so is what the ray test compares.
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    normal[k] = glm::cross(corner[next], corner[last]);
    made.error[k] = 0x1p-45 * distance[next] * distance[last] * screen.reach;
  }
  const double volume = glm::dot(corner[0], normal[0]);
  const double volume_error = 0x1p-46 * distance[0] * distance[1] * distance[2];
  made.turn_known = std::abs(volume) > 4 * volume_error;
  const double turn = volume < 0 ? -1 : 1;
  const dvec3 first = screen.dir(0, 0);
  for (int k = 0; k < 3; ++k) {
    made.a[k] = turn * glm::dot(normal[k], screen.step_x);
    made.b[k] = turn * glm::dot(normal[k], screen.step_y);
    made.c[k] = turn * glm::dot(normal[k], first);
  }
  // The three values over the volume are the corners' weights over the distance; their sum is 1 / distance.
  const double per_volume = made.turn_known ? screen.unit / std::abs(volume) : 0;
  made.depth = (made.c[0] + made.c[1] + made.c[2]) * per_volume;
  made.depth_dx = (made.a[0] + made.a[1] + made.a[2]) * per_volume;
  made.depth_dy = (made.b[0] + made.b[1] + made.b[2]) * per_volume;
  made.depth_error = 2 * (made.error[0] + made.error[1] + made.error[2]) * per_volume;
  made.depth_relative_error = made.turn_known ? 4 * volume_error / std::abs(volume) : 0;
  return made;
}

bool misses_box(const HomogeneousTriangle& t, const PixelBox& box) {
  if (!t.turn_known) return false;
  for (int k = 0; k < 3; ++k) {
    const double best = t.c[k] + t.a[k] * (t.a[k] > 0 ? box.x1 : box.x0) + t.b[k] * (t.b[k] > 0 ? box.y1 : box.y0);
    if (best < -2 * t.error[k]) return true;
  }
  return false;
}

EdgeTriangle edges_in_box(const HomogeneousTriangle& t, const PixelBox& box, int tile_x_px, int tile_y_px) {
  EdgeTriangle made;
  made.triangle = t.triangle, made.has_holes = t.has_holes, made.nearest = t.nearest;
  made.box = {box.x0 - tile_x_px, box.y0 - tile_y_px, box.x1 - tile_x_px, box.y1 - tile_y_px};
  const double width = box.x1 - box.x0 + 1, height = box.y1 - box.y0 + 1;
  for (int k = 0; k < 3; ++k) {
    // Scaled to at most 1, rounded, and evaluated with six roundings of at most that.
    const double value = t.c[k] + t.a[k] * box.x0 + t.b[k] * box.y0;
    const double largest = std::abs(t.a[k]) * width + std::abs(t.b[k]) * height + std::abs(value);
    const double scale = 1 / std::max({largest, t.error[k], 1e-300});
    made.edge[k] = static_cast<float>(value * scale);
    made.dx[k] = static_cast<float>(t.a[k] * scale), made.dy[k] = static_cast<float>(t.b[k] * scale);
    made.x_per_dx[k] = -1 / made.dx[k];
    made.error[k] = static_cast<float>((t.error[k] + 8 * kFloatRounding * largest) * scale * (1 + 1e-6));
  }
  if (!t.turn_known) {
    made.depth = made.depth_dx = made.depth_dy = made.depth_error = 0;
    return made;
  }
  const double depth = t.depth + t.depth_dx * box.x0 + t.depth_dy * box.y0;
  const double largest = std::abs(depth) + std::abs(t.depth_dx) * width + std::abs(t.depth_dy) * height;
  made.depth = static_cast<float>(depth);
  made.depth_dx = static_cast<float>(t.depth_dx), made.depth_dy = static_cast<float>(t.depth_dy);
  made.depth_error =
      static_cast<float>((t.depth_error + largest * (t.depth_relative_error + 8 * kFloatRounding)) * (1 + 1e-6));
  return made;
}

}  // namespace hybridrt
