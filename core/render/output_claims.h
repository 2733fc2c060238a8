#pragma once

#include <string_view>
#include <vector>

#include "core/base/file_claims.h"
#include "core/render/frame_spec.h"
#include "core/render/output_pattern.h"

namespace hybridrt {

/// Claims the pictures of `frames` and their AOVs: runs of other frames may go on at the same time, and one that writes
/// some of these files under other names or another pattern finds them taken. A range with a step is claimed frame by
/// frame up to 1000 frames, a longer one as if it had no step. Other patterns are not noticed where the frame number is
/// in a folder's name, or not the last number of the file's name and frames are more than 1000. Throws as
/// FileClaims::claim().
[[nodiscard]] FileClaims::Answer claim_frames(FileClaims& claims, const OutputPattern& pattern, const FrameSpec& frames,
                                              const std::vector<std::string_view>& aovs = {});

}  // namespace hybridrt
