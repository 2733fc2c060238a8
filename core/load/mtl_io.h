#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/warnings.h"
#include "core/load/material_kinds.h"
#include "core/scene/material.h"

namespace hybridrt {

/// The material of triangles that name none: Kd 0.8, nothing else.
Material default_material();

/// Reads one MTL file and appends its materials, resolved, in the file's order. Colours linear.
///  - Kd defaults to 0.8, Ks and Ke to 0, Ns 30, Ni 1, d 1, Tf 1 1 1, illum 2. One number after Kd, Ks, Ke
///    or Tf means three equal ones. Ka is read and ignored.
///  - mtl_opacity.h says what d, Tr, Tf and illum mean together for glass, and what `kinds` says instead. A warning
///  names
///    materials whose Tr or illum is not taken at its word.
///  - A Kd or Ks above 1.5 is kept, with a warning that names the material: probably 0-255 colours.
///  - Colours are clamped to >= 0, Ns to [0, 1e4], d to [0, 1]; Ni <= 0 becomes 1 and illum outside 0-10 becomes 2,
///    with a warning.
///  - map_Kd, map_Ks, map_Ke and map_d, in any case, are kept by name, the last of each kind; without a name there is
///    no map. No picture is read here. Files are looked for as find_file.h says, beside the MTL and in `more_folders`.
///    Warnings count maps of other kinds (except map_Ka), and name missing files and those found under another name.
/// Throws Error (input), naming file and line, where one of these numbers is missing, malformed, infinite or NaN, and
/// as TextLines does. Why not tinyobjloader: it reads NaN as 0 and cannot tell a missing illum, Tf or Tr from 0.
void read_mtl(const std::filesystem::path& path, std::vector<Material>& materials, Warnings& warnings,
              const MaterialKinds& kinds = {}, const std::vector<std::filesystem::path>& more_folders = {});

/// Reads the files that the `mtllib` lines of an OBJ in `folder` name. Each element of `libraries` is the rest of one
/// line: one file name with blanks in it, or several names. They are looked for as find_file.h says; one that is found
/// under another name and one that is missing gives a warning. Of materials with the same name the first is kept.
/// Textures are looked for in `folder` too. The files read are appended to `files`.
std::vector<Material> read_libraries(const std::filesystem::path& folder, const std::vector<std::string>& libraries,
                                     std::vector<std::string>& files, Warnings& warnings,
                                     const MaterialKinds& kinds = {});

}  // namespace hybridrt
