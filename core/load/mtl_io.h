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
///  - What d, Tr, Tf and illum say together about glass, and what `kinds` says instead: mtl_opacity.h. Materials whose
///    Tr or illum is not taken by its word are named in a warning.
///  - A Kd or Ks above 1.5 is kept, with a warning that names the material: 0-255 colours, probably.
///  - Colours are clamped to >= 0, Ns to [0, 1e4], d to [0, 1]; Ni <= 0 becomes 1 and illum outside of
///    0-10 becomes 2, with a warning.
///  - map_Kd, map_Ks, map_Ke and map_d are kept by name, the last of a kind; no picture is read here. Those of
///    other kinds but map_Ka are counted in a warning; so are all that are missing and all whose names lead elsewhere
///    (texture_name.h).
/// Throws Error (input), naming file and line, where a number of the above is missing, malformed, infinite
/// or NaN, and what TextLines throws. Ours instead of tinyobjloader's, which reads NaN as 0 and cannot
/// tell a missing illum, Tf or Tr from 0.
void read_mtl(const std::filesystem::path& path, std::vector<Material>& materials, Warnings& warnings,
              const MaterialKinds& kinds = {});

/// Reads what the `mtllib` lines of an OBJ in `folder` name. Each element of `libraries` is the rest of
/// one line: one file name with blanks in it, or several. A file that is not where its name says is looked
/// for by its bare name in `folder`; one that is missing gives a warning. Of materials with the same name
/// the first is kept. The files read are appended to `files`.
std::vector<Material> read_libraries(const std::filesystem::path& folder, const std::vector<std::string>& libraries,
                                     std::vector<std::string>& files, Warnings& warnings,
                                     const MaterialKinds& kinds = {});

}  // namespace hybridrt
