#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "core/scene/scene.h"
#include "core/simplify/corners.h"

namespace hybridrt {

/// "No fan": a corner of a triangle that is left alone.
inline constexpr uint32_t kNoFan = 0xFFFFFFFFu;

/// The surface of a scene as a half-edge mesh can hold it. A fan is what lies around a vertex and is connected there
/// through edges with two triangles in opposite directions; where several fans meet in a point each counts as a vertex
/// of its own. Triangles at a non-manifold or inconsistent edge, and degenerate ones, have no fans: they are left
/// alone. So every edge between fans has one triangle or two, and every fan is one sector or closed.
struct Fans {
  std::vector<uint32_t> fan_of_corner;  ///< by Corner, or kNoFan
  std::vector<uint32_t> vertex_of_fan;  ///< welded index (weld.h) into Scene::positions
  std::vector<uint8_t> kept;            ///< by fan: 1 where the vertex must stay what and where it is
};

/// Faces that meet at a larger angle make a crease: the angle beyond which normals are not smoothed (normals.h).
inline constexpr double kCreaseAngle_deg = 45;

/// The fans of a scene, and which must stay: ends of border edges, of edges across which the material, the normals,
/// the texture coordinates or the colours change (shade_alike), and of creases; points where several fans or a triangle
/// that is left alone meet, and their neighbours, so that no new edge can join two such points twice; and vertices of
/// triangles whose bound is 0. `bounds`: one a triangle. `welded`: weld_positions() of the scene's.
Fans find_fans(const Scene& scene, const Topology& topology, std::span<const uint32_t> welded,
               std::span<const float> bounds);

}  // namespace hybridrt
