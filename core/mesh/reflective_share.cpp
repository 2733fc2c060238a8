#include "core/mesh/reflective_share.h"

#include <algorithm>

#include "core/base/fixed_random.h"

namespace hybridrt {
namespace {

constexpr uint32_t kNoPatch = 0xFFFFFFFFu;

/// What becomes a mirror as a whole.
struct Patches {
  std::vector<uint32_t> patch_of_triangle;
  std::vector<uint32_t> triangles;  ///< how many each patch has
};

/// The triangles on the other side of each triangle's edges: those of triangle t are
/// triangles[first[t] .. first[t + 1]).
struct Neighbours {
  std::vector<uint32_t> first, triangles;
};

Neighbours find_neighbours(const Topology& topology) {
  const size_t count = topology.component_of_triangle.size();
  Neighbours result;
  result.first.assign(count + 1, 0);
  // Around an edge each use is linked to the next: that keeps together what shares the edge.
  const auto for_each_link = [&](const auto& visit) {
    for (size_t edge = 0; edge < topology.edges.size(); ++edge) {
      const std::span<const EdgeUse> uses = topology.uses_of(edge);
      for (size_t i = 1; i < uses.size(); ++i) visit(uses[i - 1].triangle, uses[i].triangle);
    }
  };
  for_each_link([&](uint32_t a, uint32_t b) { ++result.first[a + 1], ++result.first[b + 1]; });
  for (size_t t = 0; t < count; ++t) result.first[t + 1] += result.first[t];
  result.triangles.resize(result.first[count]);
  std::vector<uint32_t> next(result.first.begin(), result.first.end() - 1);
  for_each_link([&](uint32_t a, uint32_t b) { result.triangles[next[a]++] = b, result.triangles[next[b]++] = a; });
  return result;
}

/// A patch of up to `most` triangles that grows around `seed`, breadth first.
void grow(uint32_t seed, uint32_t most, const Neighbours& neighbours, Patches& patches, std::vector<uint32_t>& queue) {
  const auto patch = static_cast<uint32_t>(patches.triangles.size());
  queue.assign(1, seed);
  patches.patch_of_triangle[seed] = patch;
  for (size_t at = 0; at < queue.size(); ++at)
    for (uint32_t i = neighbours.first[queue[at]]; i < neighbours.first[queue[at] + 1] && queue.size() < most; ++i) {
      uint32_t& of_neighbour = patches.patch_of_triangle[neighbours.triangles[i]];
      if (of_neighbour != kNoPatch) continue;
      of_neighbour = patch;
      queue.push_back(neighbours.triangles[i]);
    }
  patches.triangles.push_back(static_cast<uint32_t>(queue.size()));
}

Patches make_patches(const Topology& topology) {
  const auto count = static_cast<uint32_t>(topology.component_of_triangle.size());
  const uint32_t most = std::max(1u, count / 100);
  const auto is_large = [&](const Component& c) { return c.triangles > most; };
  Patches patches;
  patches.patch_of_triangle.assign(count, kNoPatch);
  Neighbours neighbours;
  if (std::any_of(topology.components.begin(), topology.components.end(), is_large))
    neighbours = find_neighbours(topology);
  std::vector<uint32_t> queue, patch_of_component(topology.components.size(), kNoPatch);
  for (uint32_t t = 0; t < count; ++t) {
    if (patches.patch_of_triangle[t] != kNoPatch) continue;
    const uint32_t component = topology.component_of_triangle[t];
    if (is_large(topology.components[component])) {
      grow(t, most, neighbours, patches, queue);
      continue;
    }
    uint32_t& patch = patch_of_component[component];
    if (patch == kNoPatch) {
      patch = static_cast<uint32_t>(patches.triangles.size());
      patches.triangles.push_back(topology.components[component].triangles);
    }
    patches.patch_of_triangle[t] = patch;
  }
  return patches;
}

/// A patch is chosen when at least half of it lies within the share, in the shuffle's order.
std::vector<char> choose(const Patches& patches, double percent) {
  const double wanted = percent / 100 * static_cast<double>(patches.patch_of_triangle.size());
  std::vector<char> chosen(patches.triangles.size(), 0);
  double before = 0;
  for (uint32_t patch : shuffled(static_cast<uint32_t>(patches.triangles.size()))) {
    if (percent <= 0 || before + 0.5 * patches.triangles[patch] > wanted) break;
    chosen[patch] = 1;
    before += patches.triangles[patch];
  }
  return chosen;
}

Material mirror_of(const Material& material) {
  Material mirror = material;
  mirror.name += " (mirror)";
  mirror.illum = 3;
  mirror.opacity = 1;
  mirror.reflect = vec3(0.5f);
  mirror.transmit = vec3(0);
  mirror.fresnel = Fresnel::none;
  return mirror;
}

}  // namespace

void set_reflective_share(Scene& scene, const Topology& topology, double percent) {
  for (Material& material : scene.materials) {
    if (!material.reflective() || material.transmissive()) continue;
    material.reflect = vec3(0);
    material.fresnel = Fresnel::none;
  }
  const Patches patches = make_patches(topology);
  const std::vector<char> chosen = choose(patches, percent);
  std::vector<uint32_t> mirrors(scene.materials.size(), kNoPatch);  // made when the first triangle needs one
  for (size_t t = 0; t < scene.triangle_count(); ++t) {
    if (!chosen[patches.patch_of_triangle[t]]) continue;
    uint32_t& material = scene.triangle_materials[t];
    if (mirrors[material] == kNoPatch) {
      mirrors[material] = static_cast<uint32_t>(scene.materials.size());
      scene.materials.push_back(mirror_of(scene.materials[material]));
    }
    material = mirrors[material];
  }
}

}  // namespace hybridrt
