#pragma once

#include <filesystem>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/load/mesh_data.h"

namespace hybridrt {

/// Size of a chunk. Large enough that counting and joining cost little, small enough that little text is in memory.
inline constexpr size_t kObjChunkBytes = size_t{1} << 19;

/// Reads an OBJ in chunks of whole lines, on all threads of the pool. Statements are counted first, so that each chunk
/// knows the indices and lines before it; then chunks are read, then joined in the file's order. The result, warnings
/// and errors are the same for any number of threads and any chunk size. Throws Error (input) naming file and line;
/// warnings say what was left out.
///
/// Why not tinyobjloader: it reads line by line through a stream. Behind the checks that it needs it took two thirds of
/// the time, and it rounds the last bits of 0.1 wrongly.
MeshData parse_obj(const std::filesystem::path& path, ThreadPool& pool, Warnings& warnings,
                   LoadProgress* progress = nullptr, size_t chunk_bytes = kObjChunkBytes);

}  // namespace hybridrt
