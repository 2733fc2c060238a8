#pragma once

#include "core/render/render_job.h"

namespace hybridrt::cli {

/// Samples of each pixel that decide what a frame sees: the renderer's own (sample_offset_px), at least so many.
inline constexpr int kSeenSamples = 8;

/// The job's scene without the triangles that none of its frames sees, in any way (seen_triangles.h). The job's scene
/// if a signal asks to stop. Throws Error(input) if nothing is seen at all.
Scene without_unseen(const RenderJob& job, ThreadPool& pool);

}  // namespace hybridrt::cli
