#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hybridrt {

/// About how many bytes of memory loading a mesh file takes at its peak, from its header and size alone: what a PLY,
/// an OFF or a binary STL promises, as far as the file has room for it; for text without counts what is usual for its
/// size. 0 for what cannot be read: its reader says why.
uint64_t loading_bytes(const std::filesystem::path& path);

/// Of a procedural scene.
uint64_t making_bytes(int64_t triangles);

/// Throws Error (input) that says what `what` needs and what to do, if that is more than `most_bytes`.
void require_room_for_scene(const std::string& what, uint64_t bytes, uint64_t most_bytes);

}  // namespace hybridrt
