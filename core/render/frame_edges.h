#pragma once

#include "core/raster/visibility.h"
#include "core/render/edge_samples.h"
#include "core/render/frame.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// What finds the triangles that samples see: the exact rasteriser where there are many, rays where there are few.
struct EdgeFinders {
  const RayCaster<float>& caster;
  const Clusters* clusters;  ///< null: rays find all
  RasterMemory& raster;
  EdgeMemory& memory;
};

/// Takes the samples near edges of `frame`, whose picture has the first of each pixel (sample_edges), and adds times
/// and counts; the same for every form. `trace` has the frame's light buffers, if it has shadows.
void sample_frame_edges(const FramePlan& plan, const TraceJob& trace, const RenderSettings& settings,
                        const EdgeFinders& finders, ThreadPool& pool, Frame& frame);

}  // namespace hybridrt
