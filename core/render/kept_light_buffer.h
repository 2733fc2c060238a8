#pragma once

#include <optional>

#include "core/base/timing.h"
#include "core/trace/light_buffer.h"

namespace hybridrt {

/// The light buffer of a sequence: built when first asked for, and again only when the light has moved.
class KeptLightBuffer {
 public:
  /// Scene and pool must outlive it.
  KeptLightBuffer(const Scene& scene, ThreadPool& pool) : scene_(scene), pool_(pool) {}
  KeptLightBuffer(const KeptLightBuffer&) = delete;
  KeptLightBuffer& operator=(const KeptLightBuffer&) = delete;

  /// `toward` unit. Valid until the next call. `build_ms` is set to what building took, 0 if it was kept.
  const LightBuffer& toward(const dvec3& toward, double& build_ms) {
    build_ms = 0;
    if (buffer_ && buffer_->toward == toward) return *buffer_;
    const Stopwatch building;
    if (!sheets_) sheets_ = make_sheets(scene_, build_topology(scene_, pool_), pool_);
    buffer_.reset();  // before its successor needs the memory
    buffer_ = build_light_buffer(scene_, *sheets_, toward, pool_);
    build_ms = building.elapsed_ms();
    return *buffer_;
  }

 private:
  const Scene& scene_;
  ThreadPool& pool_;
  std::optional<Sheets> sheets_;
  std::optional<LightBuffer> buffer_;
};

}  // namespace hybridrt
