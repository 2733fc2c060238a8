#pragma once

#include <string_view>

#include "core/scene/scene.h"

namespace hybridrt {

enum class ChessFinish { plain, glass, metal };

/// Adds materials to a scene as they are asked for.
class ChessMaterials {
 public:
  /// `plain`: everything opaque and matt; mirrors are asked for one by one.
  ChessMaterials(Scene& scene, bool plain) : scene_(scene), plain_(plain) {}

  /// The index of the named material (one of the list in the .cpp), as a mirror if `mirror`.
  uint32_t find(std::string_view name, bool mirror = false);
  /// The material of a piece.
  uint32_t of_piece(bool white, ChessFinish finish, bool mirror);

 private:
  Scene& scene_;
  bool plain_;
};

}  // namespace hybridrt
