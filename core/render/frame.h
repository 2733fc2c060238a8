#pragma once

#include "core/base/timing.h"
#include "core/image/image.h"
#include "core/render/frame_plan.h"
#include "core/trace/trace_job.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hybridrt {

/// A picture kept beside the final one.
struct AovImage {
  std::string name;  ///< as in file names: id, shadow, marked, traced, depth, normal
  Image image;
};

/// A finished frame.
struct Frame {
  int number = 1;
  Image picture;  ///< three channels, linear
  std::vector<AovImage> aovs;
  FrameTimings timings;
  TraceStats stats;
};

/// Where frames come from (nothing: the sequence is over) and where they go, in order.
using NextFrame = std::function<std::optional<FrameRequest>()>;
using DeliverFrame = std::function<void(Frame&&)>;

/// Splits RGBA pixels (alpha 1 where a surface is seen, 0 elsewhere) into a three-channel picture and the
/// number of pixels that see a surface. Throws Error(device) at any other alpha: the pixels were never
/// written.
Image picture_from_rgba(const vec4* rgba, int width_px, int height_px, int64_t& pixels_hit);

}  // namespace hybridrt
