#pragma once

#include "core/base/file_claims.h"
#include "core/render/frame_spec.h"
#include "core/render/output_pattern.h"

namespace hybridrt {

/// Claims the pictures of `frames`, and with them their AOVs: runs of other frames may go on beside this one. A range
/// with a step counts frame by frame up to 1000 frames, beyond as if it had none. Throws as FileClaims::claim().
[[nodiscard]] FileClaims::Answer claim_frames(FileClaims& claims, const OutputPattern& pattern,
                                              const FrameSpec& frames);

}  // namespace hybridrt
