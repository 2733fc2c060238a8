#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/render/frame_plan.h"
#include "core/render/frame_timings.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// A finished frame.
struct Frame {
  int number = 1;
  Image picture;                 ///< three channels, linear
  std::vector<ImageLayer> aovs;  ///< as asked for (aov.h), of the same pixels
  FrameTimings timings;
  TraceStats stats;
};

/// What pass 4, or all passes on the CPU, need to know of a frame, except its light buffers. Refers to scene and plan.
TraceJob make_trace_job(const Scene& scene, const FramePlan& plan, const RenderSettings& settings);

/// Where frames come from (nothing: the sequence is over) and where they go, in order.
using NextFrame = std::function<std::optional<FrameRequest>()>;
using DeliverFrame = std::function<void(Frame&&)>;

/// Splits RGBA pixels (alpha 1 where a surface is seen, 0 elsewhere), or the part `kept` of them, into a three-channel
/// picture and the number of its pixels that see a surface. Throws Error(device) for any other alpha: such pixels were
/// never written.
Image picture_from_rgba(const vec4* rgba, int width_px, int height_px, const PixelRect& kept, int64_t& pixels_hit);

}  // namespace hybridrt
