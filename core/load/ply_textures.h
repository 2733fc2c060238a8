#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/warnings.h"
#include "core/scene/material.h"

namespace hybridrt {

/// A material for each of the names of a PLY's TextureFile comments, called as it: Kd 1 and a map_Kd. Files are looked
/// for in `folder`, as find_file.h says; warnings name those that are missing or found under another name.
std::vector<Material> texture_materials(const std::filesystem::path& ply, const std::vector<std::string>& files,
                                        Warnings& warnings);

}  // namespace hybridrt
