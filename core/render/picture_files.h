#pragma once

#include <string_view>
#include <vector>

#include "core/base/run_files.h"
#include "core/render/frame_spec.h"
#include "core/render/output_pattern.h"

namespace hybridrt {

/// The AOVs (Aov bits) that become files of their own.
std::vector<std::string_view> aov_names(uint32_t aovs);

/// Throws Error(usage) if a picture of `frames`, or one of its AOVs, is among `files`. Only those frames are tried
/// whose number is in the name of one of the files or of what lies in the pictures' folder: the frames need not be few.
void require_pictures_unused(const RunFiles& files, const OutputPattern& pattern, const FrameSpec& frames,
                             const std::vector<std::string_view>& aovs);

}  // namespace hybridrt
