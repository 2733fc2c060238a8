#pragma once

#include <optional>
#include <vector>

#include "core/base/timing.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// The light buffers of a sequence, one per light: built when first needed, and again only when the light has moved.
class KeptLightBuffers {
 public:
  /// All three must outlive it.
  KeptLightBuffers(const Scene& scene, const Sheets& sheets, ThreadPool& pool)
      : scene_(scene), sheets_(sheets), pool_(pool) {}
  KeptLightBuffers(const KeptLightBuffers&) = delete;
  KeptLightBuffers& operator=(const KeptLightBuffers&) = delete;

  /// Sets the buffers of the job's lights that cast shadows, valid until the next call, and eye_enclosed. Returns the
  /// milliseconds that building took, 0 if all were kept.
  double answer(TraceJob& job) {
    double build_ms = 0;
    const LightBuffer* any = nullptr;
    buffers_.resize(job.lights.size());
    for (size_t l = 0; l < job.lights.size(); ++l)
      if (job.casts_shadow(l)) any = job.lights[l].buffer = &toward(l, job.lights[l].light.toward, build_ms);
    job.eye_enclosed = any && may_be_enclosed(*any, job.view.eye);  // the same for every light
    return build_ms;
  }

 private:
  const LightBuffer& toward(size_t light, const dvec3& toward, double& build_ms) {
    std::optional<LightBuffer>& buffer = buffers_[light];
    if (buffer && buffer->toward == toward) return *buffer;
    const Stopwatch building;
    buffer.reset();  // frees the memory for its successor
    buffer = build_light_buffer(scene_, sheets_, toward, pool_);
    build_ms += building.elapsed_ms();
    return *buffer;
  }

  const Scene& scene_;
  const Sheets& sheets_;
  ThreadPool& pool_;
  std::vector<std::optional<LightBuffer>> buffers_;  ///< by light
};

}  // namespace hybridrt
