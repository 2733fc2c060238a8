#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hybridrt {

/// The file name in what follows map_Kd and its like: options (-blendu, -bm, -clamp, -imfchan, -mm, -o, -s,
/// -t, -texres, -type, …) with their values are passed over, in front of the name and behind it; blanks
/// inside the name stay. Empty where there is none.
std::string texture_name(std::string_view statement);

/// Where a texture was looked for.
struct TextureFile {
  std::filesystem::path path;  ///< empty: there is no such file
  bool foreign = false;  ///< the name leads elsewhere (absolute, `..`, a Windows drive): only its last part
                         ///< was looked for, beside the MTL
};

/// Never outside of `folder`, in which the MTL lies. Backslashes divide folders like slashes do.
TextureFile find_texture(const std::filesystem::path& folder, std::string name);

}  // namespace hybridrt
