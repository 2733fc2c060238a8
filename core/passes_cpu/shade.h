#pragma once

#include <span>

#include "core/trace/seen_points.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// Pass 5 on the CPU (paper, section 3.4), many pixels at once: ambient + each light that arrives · (diffuse +
/// specular), by the texts of the GL form (shaders/surface.glsl, texture.glsl). What reflected and refracted rays bring
/// is added elsewhere. The same bits under every instruction set. `lit`: per point, bit l is set where light l arrives.
/// `colors`: red, green and blue per point.
void shade(const TraceJob& job, const SeenPoints& points, std::span<const uint8_t> lit,
           float (&colors)[3][SeenPoints::kRoom]);

}  // namespace hybridrt
