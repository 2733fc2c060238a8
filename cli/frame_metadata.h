#pragma once

#include "core/image/image_metadata.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// What a run's pictures say about themselves, but for what differs from frame to frame.
struct RunMetadata {
  uint64_t scene_fingerprint = 0;
  std::string form;    ///< "cpu", or the OpenGL that draws and the fingerprint of its shaders; what answers rays
  std::string layers;  ///< the AOVs that pictures hold as layers; empty: none
  bool halfs = false;  ///< EXRs hold half numbers
};

/// `layered`: AOVs are layers of the pictures.
RunMetadata run_metadata(const RenderJob& job, const RunFacts& facts, bool layered);

/// Equal for two frames if and only if their files hold the same pixels, and the same bytes where --compression is the
/// same, as far as one can know: version, settings, scene, camera, lights, form of the passes.
ImageMetadata frame_metadata(const RunMetadata& run, const RenderJob& job, int frame);

}  // namespace hybridrt::cli
