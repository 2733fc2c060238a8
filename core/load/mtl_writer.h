#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/output_file.h"
#include "core/base/warnings.h"
#include "core/scene/material.h"

namespace hybridrt {

/// A name for each material under which MTL and OBJ can tell it from the others: its own, with a number after it where
/// another has it already; "unnamed" where it has none.
std::vector<std::string> distinct_names(std::span<const Material> materials);

/// Writes resolved materials so that read_mtl() gives the same. Texture files are named as seen from `folder`. Glass is
/// illum 6, which asks for refraction whatever the material's colour is, and else is as 4.
void write_mtl(std::span<const Material> materials, std::span<const std::string> names,
               const std::filesystem::path& folder, OutputFile& file);

/// Reads `path` back and warns of materials that differ from what was written: what MTL cannot hold, textures whose
/// files are missing among it. Throws Error(input) as read_mtl().
void warn_of_lost_materials(std::span<const Material> materials, const std::filesystem::path& path, Warnings& warnings);

}  // namespace hybridrt
