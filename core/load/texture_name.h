#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/scene/texture_map.h"

namespace hybridrt {

/// What follows map_Kd and its like.
struct TextureStatement {
  std::string name;  ///< blanks inside stay; empty where there is none
  TextureMap map;    ///< by its options; kind and path are the caller's
};

/// Options stand in front of the name or behind it. Read are -s, -o, -clamp, -mm and -imfchan; -blendu, -blendv, -bm,
/// -boost, -cc, -t, -texres and -type are passed over with their values. Options whose values are no numbers change
/// nothing; factors and offsets are kept below a million.
TextureStatement read_texture_statement(std::string_view statement);

/// Where a texture was looked for.
struct TextureFile {
  std::filesystem::path path;  ///< empty: there is no such file
  bool foreign = false;        ///< the name leads elsewhere (absolute, `..`, a Windows drive): only its last part
                               ///< was looked for, beside the MTL
};

/// Never outside of `folder`, in which the MTL lies. Backslashes divide folders like slashes do.
TextureFile find_texture(const std::filesystem::path& folder, std::string name);

}  // namespace hybridrt
