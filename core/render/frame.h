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
  Image picture;                 ///< linear; three channels, or four if the settings ask for alpha
  std::vector<ImageLayer> aovs;  ///< as asked for (aov.h), of the same pixels
  FrameTimings timings;
  TraceStats stats;
  bool repeated = false;  ///< it shows what the one before shows, and was not rendered (still_frames.h)
};

/// What pass 4, or all passes on the CPU, need to know of a frame, except its light buffers. Refers to scene and plan.
TraceJob make_trace_job(const Scene& scene, const FramePlan& plan, const RenderSettings& settings);

/// Where frames come from (nothing: the sequence is over) and where they go, in order.
using NextFrame = std::function<std::optional<FrameRequest>()>;
using DeliverFrame = std::function<void(Frame&&)>;

/// Delivers what `render` makes of each request, one after the other, with its wall time.
void render_each(const NextFrame& next, const DeliverFrame& deliver,
                 const std::function<Frame(const FrameRequest&)>& render);

/// The part `kept` of pixels whose alpha is one of HRT_ALPHA_* as a picture with three channels, or with four: then
/// alpha is 1 where a surface is seen, and all is 0 elsewhere. Counts `pixels_hit` and `pixels_lit` in `stats`. Throws
/// Error(device) for any other alpha: such pixels were never written.
Image picture_from_rgba(const vec4* rgba, int width_px, int height_px, const PixelRect& kept, bool with_alpha,
                        TraceStats& stats);

}  // namespace hybridrt
