#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/load/mesh_data.h"
#include "core/scene/scene.h"
#include "core/scene/up_axis.h"

namespace hybridrt {

/// Read PLY (text, binary in either byte order), OFF (text) and STL (text, binary) as written. Polygons are cut into
/// triangles, vertex normals kept, colours and texture coordinates ignored (colours with a warning), other elements and
/// properties skipped. STL facet normals only repeat the geometry and are ignored; each facet has three vertices of its
/// own.
///
/// Numbers are read in double. Every number and index is checked. Memory is bounded by what the file holds, whatever
/// its header promises. Throw Error (input), naming the file and the line or element, if the file is missing, a
/// directory, not of the format or cut short, for a coordinate that is not a number below 1e30, and for an index
/// without a vertex.
///
/// Why not OpenMesh's readers (tried at 9.0): they keep single precision only (a scene 1e7 from the origin collapses),
/// read NaN, a misspelt number and whatever follows it as 0 and report success, do not read PLY coordinates given as
/// whole numbers, and drop STL's degenerate facets silently. Checking the text first would take the same parser.
MeshData read_ply(const std::filesystem::path& path, Warnings& warnings);
MeshData read_off(const std::filesystem::path& path, Warnings& warnings);
MeshData read_stl(const std::filesystem::path& path, Warnings& warnings);

/// ".obj, .ply, .off or .stl", for messages.
inline constexpr const char* kMeshFormats = ".obj, .ply, .off or .stl";
/// Whether the extension, in whatever case, is one of these.
bool is_mesh_file(const std::filesystem::path& path);

/// By the extension. Directories and unknown extensions count as OBJ, whose reader says what is wrong.
enum class MeshFormat { obj, ply, off, stl };
MeshFormat mesh_format_of(const std::filesystem::path& path);

/// Reads one or several meshes, of any of the formats, into one validated scene with one origin (assemble_scene). Large
/// OBJs are read one after the other on all threads, the others in parallel; warnings come in the meshes' order. Files
/// whose z axis points up are turned so that y points up.
///
/// Throws Error (input) before reading any if together they would take more than watch.most_bytes of memory
/// (loading_bytes.h).
Scene load_meshes(std::span<const std::filesystem::path> paths, UpAxis up, ThreadPool& pool, Warnings& warnings,
                  const LoadWatch& watch = {});

}  // namespace hybridrt
