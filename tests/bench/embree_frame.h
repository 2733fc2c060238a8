#pragma once

#include <memory>

#include "core/trace/trace_job.h"

namespace hybridrt {

class EmbreeScene;

/// The baseline: a frame as a plain program on top of Embree would render it, in packets of 16 primary and 16 shadow
/// rays, mirrors and glass ray by ray, with our Phong shading (a packet at once) and scattering. It shares no tracing
/// code with the product.
class EmbreeFrame {
 public:
  explicit EmbreeFrame(const Scene& scene, int threads);
  ~EmbreeFrame();

  /// `picture`: linear, one element per pixel of job.view.
  void render(const TraceJob& job, ThreadPool& pool, std::span<vec4> picture) const;

 private:
  std::unique_ptr<EmbreeScene> scene_;
};

}  // namespace hybridrt
