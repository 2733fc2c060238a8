#pragma once

#include <cstdint>
#include <optional>

#include "core/scene/scene.h"
#include "core/scene/scene_shot.h"

namespace hybridrt {

/// A chess board in the middle of a game, on a round table: turned pieces, carved knights.
struct ChessOptions {
  int64_t triangles = 300'000;  ///< aimed at, kFewestTriangles to kMostTriangles; met within 5 %

  /// Absent: the set as it was designed, of wood, some pieces of glass and of metal, on a polished board. Present:
  /// everything is opaque and matt except this percentage of the connected components (at least one above 0; nested as
  /// it grows), which become mirrors that reflect half of the light (illum 3, Ks 0.5).
  std::optional<double> reflective_percent;

  static constexpr int64_t kFewestTriangles = 10'000, kMostTriangles = 20'000'000;
};

/// Squares are one unit wide, y is up, the middle of the board's surface is the origin, White sits at +z. The position
/// is the Immortal Game (Anderssen - Kieseritzky, London 1851) after White's 18th move, with the five captured pieces
/// beside the board. All components are closed meshes with outward winding and a small gap between them. A pure
/// function: same options, same scene.
Scene make_chess(const ChessOptions& options);

/// From behind White's queenside, lit from the left.
SceneShot chess_shot();

}  // namespace hybridrt
