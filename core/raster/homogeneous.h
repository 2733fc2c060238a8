#pragma once

#include "core/raster/depth_tile.h"
#include "core/raster/screen.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// A triangle ready to be sampled in a rectangle of a tile. Coordinates count from the rectangle's first pixel. At (x,
/// y) edge function i is edge[i] + x dx[i] + y dy[i], in error by at most error[i]: positive inside, in any unit. What
/// lies within the error of an edge is decided later, in double precision.
struct EdgeTriangle {
  float edge[3], dx[3], dy[3], error[3];
  float x_per_dx[3];                             ///< -1 / dx
  float depth, depth_dx, depth_dy, depth_error;  ///< unit / distance
  float nearest;                                 ///< an upper bound of unit / distance anywhere on it
  PixelBox box;                                  ///< pixels of the tile, inclusive
  uint32_t triangle;
  bool has_holes;
};

/// A triangle's edge functions along rays, in double precision: value i at the ray of pixel (x, y) is
/// c[i] + x a[i] + y b[i], positive inside, in error by at most error[i]. There is no division by depth, so it needs no
/// clipping where it reaches behind the eye. Source: Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous
/// Coordinates", Graphics Hardware 1997.
struct HomogeneousTriangle {
  double a[3], b[3], c[3], error[3];
  double depth, depth_dx, depth_dy;  ///< unit / distance at pixel (0, 0), and its steps
  double depth_error, depth_relative_error;
  bool turn_known;  ///< else it is seen so exactly edge-on that the signs may all be wrong
  bool has_holes;
  float nearest;
  uint32_t triangle;
};

/// `nearest`: an upper bound of unit / distance of what is seen of it.
HomogeneousTriangle make_homogeneous(const Scene& scene, const Screen& screen, uint32_t triangle, float nearest);

/// Whether the triangle certainly misses all pixels of the box (of the picture).
bool misses_box(const HomogeneousTriangle& triangle, const PixelBox& box);

/// For the pixels of `box` (of the picture) in the tile that begins at (tile_x_px, tile_y_px).
EdgeTriangle edges_in_box(const HomogeneousTriangle& triangle, const PixelBox& box, int tile_x_px, int tile_y_px);

}  // namespace hybridrt
