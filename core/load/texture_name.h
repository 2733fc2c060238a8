#pragma once

#include <string>
#include <string_view>

#include "core/scene/texture_map.h"

namespace hybridrt {

/// What follows map_Kd and the other map statements.
struct TextureStatement {
  std::string name;  ///< may hold blanks; empty where there is none
  TextureMap map;    ///< as its options say; the caller fills in kind and path
};

/// Options may come before or after the name. -s, -o, -clamp, -mm and -imfchan are read; -blendu, -blendv, -bm, -boost,
/// -cc, -t, -texres and -type are skipped with their values; inside quotes there are none. Options whose values are not
/// numbers change nothing; factors and offsets are kept below a million.
TextureStatement read_texture_statement(std::string_view statement);

}  // namespace hybridrt
