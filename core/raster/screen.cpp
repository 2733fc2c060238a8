#include "core/raster/screen.h"

#include <algorithm>

#include "core/base/check.h"

namespace hybridrt {

Screen make_screen(const View& view, const Aabb& bounds, double spread_px) {
  HRT_CHECK(view.width_px <= 65536 && view.height_px <= 65536);
  Screen screen;
  screen.width_px = view.width_px, screen.height_px = view.height_px;
  screen.eye = view.eye, screen.right = view.right, screen.up = view.up, screen.forward = view.forward;
  screen.scale_x = view.frame_width_px / (2 * view.tan_half_width);
  screen.scale_y = view.frame_height_px / (2 * view.tan_half_height);
  screen.middle_x = view.frame_width_px / 2.0 - 0.5 - view.sample_px.x - view.x_px;
  screen.middle_y = view.frame_height_px / 2.0 - 0.5 - view.sample_px.y - view.y_px;
  screen.sample_px = view.sample_px, screen.spread_px = spread_px;
  screen.x_px = view.x_px, screen.y_px = view.y_px;
  screen.frame_first = view.ray_first();
  screen.step_x = view.ray_step_x(), screen.step_y = view.ray_step_y();
  for (const int x : {0, view.width_px})
    for (const int y : {0, view.height_px}) screen.reach = std::max(screen.reach, glm::length(screen.dir(x, y)));

  if (bounds.empty()) return screen;
  const dvec3 size = glm::max(glm::abs(dvec3(bounds.lo)), glm::abs(dvec3(bounds.hi)));
  const double largest = std::max({size.x, size.y, size.z, glm::length(view.eye)});
  const double extent = glm::length(dvec3(bounds.hi) - dvec3(bounds.lo));
  screen.fits_float = largest < 1e15 && extent > 1e-15 && screen.scale_x < 1e9 && screen.scale_y < 1e9;
  screen.unit = std::exp2(std::round(std::log2(std::max(extent, 1e-300))));
  return screen;
}

}  // namespace hybridrt
