#pragma once

#include <functional>
#include <span>

#include "core/base/parallel.h"
#include "core/mesh/topology.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// A scene with fewer triangles, by collapses of edges into one of their ends, cheapest first by quadrics: vertices
/// vanish, and what remains keeps its place, normal, texture coordinates, colour and material. Sources: Garland and
/// Heckbert, Surface Simplification Using Quadric Error Metrics, 1997; OpenMesh's decimater with its modules for
/// quadrics, flipped normals and aspect ratios, and our own for bounds (decimation_modules.h), after Kobbelt, Campagna
/// and Seidel, A General Framework for Mesh Decimation, 1998.
///
/// `bounds`: one a triangle, scene units, >= 0: how far the new surface may be from it. 0 keeps its vertices. Borders,
/// seams of material, normals, texture coordinates and colours, and creases keep their vertices (kept_vertices.h); what
/// is non-manifold is left alone; a closed component stays closed. The bounds hold at samples of the original surface;
/// surface_distance.h measures what holds everywhere else.
///
/// `stop` is asked now and then; true ends it with what is done so far. One thread. Throws CheckFailed, std::bad_alloc.
Scene decimate(const Scene& scene, const Topology& topology, std::span<const float> bounds, ThreadPool& pool,
               const std::function<bool()>& stop = {});

}  // namespace hybridrt
