#pragma once

#include "core/gl/context.h"

namespace hybridrt::gl {

/// Draws three triangles with ids and depths, and lets a compute shader work on them: answers that are known, pixel by
/// pixel. Throws Error(device) that says which is wrong, in one clause: some drivers draw wrong pictures and report no
/// error. The context must be current.
void require_right_answers(const Context& context);

}  // namespace hybridrt::gl
