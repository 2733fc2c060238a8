#pragma once

#include <string>
#include <vector>

namespace hybridrt {

/// Materials that a scene JSON calls glass or opaque by their names, whatever their MTL files say. No name is in both.
struct MaterialKinds {
  std::string where;  ///< the scene JSON, for messages
  std::vector<std::string> glass, opaque;
};

}  // namespace hybridrt
