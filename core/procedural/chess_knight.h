#pragma once

#include "core/procedural/patch_mesh.h"

namespace hybridrt {

/// The knight's horse head, facing +x, slightly above its turned foot: a closed surface of about `triangles` triangles
/// (within a tenth from 1,000 on).
TriangleMesh carve_knight(int64_t triangles);

}  // namespace hybridrt
