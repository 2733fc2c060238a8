#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/load/material_kinds.h"
#include "core/load/mesh_data.h"
#include "core/scene/scene.h"
#include "core/scene/up_axis.h"

namespace hybridrt {

/// PLY (text, binary of either byte order), OFF (text) and STL (text, binary) as written. Polygons are cut,
/// vertex normals kept, colours and texture coordinates ignored (colours with a warning), other elements and
/// properties skipped. STL's facet normals only repeat the geometry and are ignored; its vertices are three a
/// facet.
///
/// Numbers are read in double, every one of them and every index is checked, and memory is bounded by what
/// the file really holds, whatever its header promises. Throws Error (input) naming the file and the line or
/// element: missing, a directory, not of the format, cut short, a coordinate that is none or not below 1e30,
/// an index that is not a vertex.
///
/// Ours and not OpenMesh's readers, tried at 9.0: those keep single precision only (a scene 1e7 from the
/// origin collapses), take NaN, a misspelt number and whatever follows it for 0 and report success, read
/// nothing of PLY coordinates given as whole numbers, and leave out STL's degenerate facets uncounted;
/// feeding them checked text would take the same parser in front.
MeshData read_ply(const std::filesystem::path& path, Warnings& warnings);
MeshData read_off(const std::filesystem::path& path, Warnings& warnings);
MeshData read_stl(const std::filesystem::path& path, Warnings& warnings);

/// ".obj, .ply, .off or .stl", for messages.
inline constexpr const char* kMeshFormats = ".obj, .ply, .off or .stl";
/// Whether the extension, in whatever case, is one of these.
bool is_mesh_file(const std::filesystem::path& path);

/// By the extension. What has a directory's name or none of ours is taken for OBJ, whose reader says what is wrong.
enum class MeshFormat { obj, ply, off, stl };
MeshFormat mesh_format_of(const std::filesystem::path& path);

/// Reads one or several meshes, of any of the formats, into one validated scene with one origin
/// (assemble_scene). Large OBJs are read one after the other on all threads, the others side by side; warnings come in
/// the meshes' order. Files whose z axis points up are turned so that y does.
///
/// Materials that `kinds` names become what it says. Throws Error (input) for a name that no MTL file of them defines.
///
/// Throws Error (input) before reading any when together they would take more than watch.most_bytes of memory
/// (loading_bytes.h).
Scene load_meshes(std::span<const std::filesystem::path> paths, UpAxis up, ThreadPool& pool, Warnings& warnings,
                  const LoadWatch& watch = {}, const MaterialKinds& kinds = {});

}  // namespace hybridrt
