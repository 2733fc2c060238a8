#pragma once

#include "core/raster/visibility.h"
#include "core/trace/kd_caster.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {

/// A view in, on or around the scene, in any direction, of any of several sizes and fields of view, now and then of a
/// part of the frame or off the pixels' centres, and sometimes so that pixel centres fall on vertices and edges.
View random_view(const Scene& scene, Random& random);

/// The triangle that each pixel of the view sees by the double-precision ray test: the truth.
std::vector<uint32_t> reference_ids(const RayCaster<double>& caster, const View& view, ThreadPool& pool);

std::vector<uint32_t> rasterized_ids(const Scene& scene, const Clusters& clusters, const View& view, ThreadPool& pool);

/// What the rasteriser finds at several samples of some pixels of a view.
struct SampledPixels {
  std::vector<View> views;  ///< of each sample
  std::vector<PixelAt> pixels;
  std::vector<uint32_t> triangles;  ///< per pixel and sample
};

/// At 1 to 20 samples, and at few, half or all of the pixels. Some samples lie on a grid of quarters of a pixel around
/// the view's own.
SampledPixels sample_some_pixels(const Scene& scene, const Clusters& clusters, View view, ThreadPool& pool,
                                 Random& random);

/// How many of them the double-precision ray test finds otherwise.
int wrong_samples(const RayCaster<double>& caster, const SampledPixels& sampled, ThreadPool& pool);

/// More scenes that rasterisers stumble over.
Scene doubled_faces(uint32_t seed);  ///< every triangle again, wound the other way and from another corner
Scene sheet_on_centers(int cells);   ///< seen by sheet_view(), vertices and edges fall on pixel centres
View sheet_view(int cells, double height);
View sheet_view_beside(int cells, Random& random);  ///< centres miss vertices and edges by 1e-9 to 1e-3 of a pixel
Scene nearly_one_plane(uint32_t seed);              ///< overlapping triangles, as far apart as floats can tell
View view_of_plane(Random& random);                 ///< of it, as a rule aslant
Scene huge_and_small(uint32_t seed);                ///< sizes from 1e-2 to 1e6

}  // namespace hybridrt
