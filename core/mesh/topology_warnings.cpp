#include "core/mesh/topology_warnings.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/warnings.h"

namespace hybridrt {
namespace {

void warn_of_open_refraction(const Scene& scene, const Topology& topology, Warnings& warnings) {
  std::vector<bool> is_counted(topology.components.size());
  size_t triangles = 0, components = 0;
  const Material* first = nullptr;
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    const Material& material = scene.material_of(i);
    const uint32_t component = topology.component_of_triangle[i];
    if (!material.bends_light() || topology.components[component].closed()) continue;
    if (!first) first = &material;
    ++triangles;
    if (!is_counted[component]) ++components;
    is_counted[component] = true;
  }
  if (triangles > 0)
    warnings.emplace_back(
        WarningCode::glass_open,
        fmt::format(
            "{} triangles in {} open components refract (first: material {}), where inside and outside cannot be "
            "told apart; close the mesh or give the material Ni 1",
            triangles, components, in_quotes(first->name)));
}

}  // namespace

void topology_warnings(const Scene& scene, const Topology& topology, Warnings& warnings) {
  if (topology.non_manifold_edges > 0)
    warnings.emplace_back(
        WarningCode::mesh_non_manifold,
        fmt::format("{} edges belong to more than two triangles (non-manifold); kept, but their meshes have no inside",
                    topology.non_manifold_edges));
  warn_of_open_refraction(scene, topology, warnings);
}

}  // namespace hybridrt
