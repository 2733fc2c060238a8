#pragma once

#include <cstddef>

#include "core/base/warnings.h"
#include "core/load/mesh_data.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Marks vertices and faces without a colour of their own in MeshData::colors.
inline constexpr vec3 kNoColor{-1};

/// Three numbers as a colour: NaN is none, others are kept between 0 and a large number.
vec3 color_of_numbers(const dvec3& numbers);

/// Whether colours say something: neither all black nor all white, as programs write what nobody has painted.
/// `full`: as MeshData::color_full.
bool has_plain_colors(const std::vector<vec3>& colors, float full);

/// Gives a mesh that may have colours of vertices those of its faces, unless the vertices' say something (then a
/// warning tells of it). `triangles`: for each triangle an index into `of_faces`, or kNoIndex; empty: none anywhere.
void add_face_colors(MeshData& mesh, std::vector<vec3>&& of_faces, const std::vector<uint32_t>& triangles, float full,
                     Warnings& warnings);

/// Appends a mesh's colours to those of the scene. The mesh's triangles are the scene's from `first_triangle` on, and
/// its vertex 0 is the scene's `first_vertex`; their materials are 1 + an index, 0 for none.
///  - Colours are decoded from sRGB, unless they are `linear`.
///  - Triangles with a colour and without a material get a material of Kd 1: `colored_material`, 1 + its index, which
///  is
///    made if it is 0.
///  - Triangles whose material has a map_Kd, and corners without a colour, are white.
/// Nothing is kept where all are black or all white, or no triangle uses one. One line says what was done: a warning if
/// colours were left out, else a note of the scene.
void take_colors(MeshData& mesh, size_t first_triangle, uint32_t first_vertex, bool linear, Scene& scene,
                 uint32_t& colored_material, Warnings& warnings);

}  // namespace hybridrt
