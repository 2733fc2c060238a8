#pragma once

#include <filesystem>

namespace hybridrt {

enum class MeshFormat { obj, ply, off, stl, om };

/// ".obj, .ply, .off, .stl or .om", for messages.
inline constexpr const char* kMeshFormats = ".obj, .ply, .off, .stl or .om";

/// Whether the extension, in whatever case, is one of these.
bool is_mesh_file(const std::filesystem::path& path);

/// By the extension. Directories and unknown extensions count as OBJ, whose reader says what is wrong.
MeshFormat mesh_format_of(const std::filesystem::path& path);

}  // namespace hybridrt
