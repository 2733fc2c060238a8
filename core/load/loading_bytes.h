#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hybridrt {

/// About how many bytes of memory loading a mesh file takes at its peak, from its header and size alone: for PLY, OFF
/// and binary STL by the header's counts, as far as the file has room for them; for text without counts by what is
/// usual for its size. 0 for a file that cannot be read: its reader says why.
uint64_t loading_bytes(const std::filesystem::path& path);

/// The same for a procedural scene.
uint64_t making_bytes(int64_t triangles);

/// Throws Error (input) that says what `what` needs and what to do, if that is more than `most_bytes`.
void require_room_for_scene(const std::string& what, uint64_t bytes, uint64_t most_bytes);

}  // namespace hybridrt
