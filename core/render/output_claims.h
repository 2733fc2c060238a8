#pragma once

#include "core/base/file_claims.h"
#include "core/render/frame_spec.h"
#include "core/render/output_pattern.h"

namespace hybridrt {

/// Claims the pictures of `frames` and their AOVs: runs of other frames may go on at the same time. A range with a step
/// is claimed frame by frame up to 1000 frames, a longer one as if it had no step. Throws as FileClaims::claim().
[[nodiscard]] FileClaims::Answer claim_frames(FileClaims& claims, const OutputPattern& pattern,
                                              const FrameSpec& frames);

}  // namespace hybridrt
