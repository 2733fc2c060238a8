#pragma once

#include "core/base/warnings.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Names the materials whose triangles nobody can see, with their number and why: d 0, clear glass of Ni 1, or a
/// texture that is all holes. Those of which only highlights or glow are left at d 0 are told as well. Empty pictures
/// have a reason then.
void report_invisible(const Scene& scene, Warnings& warnings);

}  // namespace hybridrt
