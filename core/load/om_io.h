#pragma once

#include <filesystem>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

/// OpenMesh's own binary format, through OpenMesh's reader, which gets only what om_chunks.h has checked. It hands over
/// vertices and faces one by one, so that nothing is lost that a half-edge mesh cannot hold. Kept: positions (single or
/// double precision), normals and colours of vertices, colours of faces; polygons are cut into triangles. OM holds no
/// materials. Throws Error(input), naming the file, as read_om_chunks(), and for an index without a vertex, a face that
/// is no cycle, and a face with a coordinate that is not a number below 1e30.
MeshData read_om(const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
