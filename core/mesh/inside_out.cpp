#include "core/mesh/inside_out.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/mesh/nesting.h"

namespace hybridrt {
namespace {

constexpr uint32_t kNoMaterial = 0xFFFFFFFFu;

/// For each component the material of all its triangles if that bends light, else kNoMaterial.
std::vector<uint32_t> glass_of_components(const Scene& scene, const Topology& topology) {
  std::vector<uint32_t> glass(topology.components.size(), kNoMaterial);
  for (size_t c = 0; c < glass.size(); ++c) {
    const uint32_t material = scene.triangle_materials[topology.components[c].first_triangle];
    if (scene.materials[material].bends_light()) glass[c] = material;
  }
  for (size_t t = 0; t < scene.triangle_count(); ++t) {
    uint32_t& of_component = glass[topology.component_of_triangle[t]];
    if (of_component != scene.triangle_materials[t]) of_component = kNoMaterial;
  }
  return glass;
}

double box_volume(const Aabb& box) {
  const dvec3 extent(box.extent());
  return extent.x * extent.y * extent.z;
}

/// Goes through the closed components from the outermost to the innermost.
class Turner {
 public:
  Turner(const Scene& scene, const Topology& topology, ThreadPool& pool)
      : topology_(topology),
        nesting_(find_nesting(scene, topology, pool)),
        glass_(glass_of_components(scene, topology)),
        meaning_(topology.components.size(), Meaning::body),
        turned_(topology.components.size()) {}

  std::vector<uint32_t> find() {
    std::vector<uint32_t> order, result;
    for (uint32_t c = 0; c < topology_.components.size(); ++c)
      if (topology_.components[c].winding != Winding::none) order.push_back(c);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return box_volume(nesting_.boxes[a]) > box_volume(nesting_.boxes[b]);
    });
    for (const uint32_t c : order) decide(c);
    for (uint32_t c = 0; c < turned_.size(); ++c)
      if (turned_[c]) result.push_back(c);
    return result;
  }

 private:
  enum class Meaning : uint8_t { body, cavity, room };

  void decide(uint32_t c) {
    int solids = 0;  // bodies around, less the cavities around
    bool in_turned_glass = false;
    for (const uint32_t outer : nesting_.enclosers[c]) {
      if (meaning_[outer] == Meaning::body) ++solids;
      if (meaning_[outer] == Meaning::cavity) --solids;
      in_turned_glass |= turned_[outer] && glass_[c] != kNoMaterial && glass_[outer] == glass_[c];
    }
    const bool is_inward = topology_.components[c].winding == Winding::inward;
    if (in_turned_glass)
      meaning_[c] = solids > 0 ? Meaning::cavity : Meaning::body;
    else if (is_inward && solids > 0)
      meaning_[c] = Meaning::cavity;
    else if (is_inward && glass_[c] == kNoMaterial && !nesting_.contents[c].empty())
      meaning_[c] = Meaning::room;
    turned_[c] = is_inward == (meaning_[c] == Meaning::body);
  }

  const Topology& topology_;
  const Nesting nesting_;
  const std::vector<uint32_t> glass_;
  std::vector<Meaning> meaning_;
  std::vector<bool> turned_;
};

/// For each of the components whether most of its normals point the way that it is wound: a mirrored export may have
/// turned its normals and not its triangles.
std::vector<bool> normals_follow_winding(const Scene& scene, const Topology& topology) {
  std::vector<int64_t> agreeing(topology.components.size());
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    const vec3 a = scene.vertex(t, 0), face = glm::cross(scene.vertex(t, 1) - a, scene.vertex(t, 2) - a);
    for (int corner = 0; corner < 3; ++corner)
      agreeing[topology.component_of_triangle[t]] +=
          glm::dot(face, scene.normals[scene.triangle_normals[t][corner]]) > 0 ? 1 : -1;
  }
  std::vector<bool> follow(agreeing.size());
  std::transform(agreeing.begin(), agreeing.end(), follow.begin(), [](int64_t sum) { return sum >= 0; });
  return follow;
}

/// Negates the normals of these triangles: in place, or in copies where others need them as they are.
void negate_normals(Scene& scene, const std::vector<bool>& is_negated) {
  constexpr uint32_t kNone = 0xFFFFFFFFu;
  std::vector<bool> is_needed(scene.normals.size());
  for (size_t t = 0; t < scene.triangle_count(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      if (!is_negated[t]) is_needed[scene.triangle_normals[t][corner]] = true;
  std::vector<uint32_t> negative(scene.normals.size(), kNone);
  for (size_t t = 0; t < scene.triangle_count(); ++t)
    for (int corner = 0; corner < 3 && is_negated[t]; ++corner) {
      uint32_t& normal = scene.triangle_normals[t][corner];
      if (negative[normal] == kNone) {
        const vec3 turned = -scene.normals[normal];
        negative[normal] = is_needed[normal] ? static_cast<uint32_t>(scene.normals.size()) : normal;
        if (is_needed[normal])
          scene.normals.push_back(turned);
        else
          scene.normals[normal] = turned;
      }
      normal = negative[normal];
    }
}

/// Texture coordinates of the second and third corner change places.
void turn_texcoords(Scene& scene, const std::vector<bool>& is_turned) {
  if (!scene.textures) return;
  auto textures =
      std::const_pointer_cast<Textures>(scene.textures);  // the scene is still being made: nobody shares them
  for (size_t t = 0; t < scene.triangle_count(); ++t)
    if (is_turned[t]) std::swap(textures->triangle_texcoords[t].y, textures->triangle_texcoords[t].z);
}

}  // namespace

std::vector<uint32_t> find_inside_out(const Scene& scene, const Topology& topology, ThreadPool& pool) {
  const bool any = std::any_of(topology.components.begin(), topology.components.end(),
                               [](const Component& c) { return c.winding == Winding::inward; });
  return any ? Turner(scene, topology, pool).find() : std::vector<uint32_t>();
}

void turn_components(Scene& scene, Topology& topology, const std::vector<uint32_t>& components) {
  std::vector<bool> is_turned_component(topology.components.size());
  for (const uint32_t c : components) {
    is_turned_component[c] = true;
    Winding& winding = topology.components[c].winding;
    winding = winding == Winding::inward ? Winding::outward : Winding::inward;
  }
  const std::vector<bool> follow = normals_follow_winding(scene, topology);
  std::vector<bool> is_turned(scene.triangle_count()), is_negated(scene.triangle_count());
  for (size_t t = 0; t < is_turned.size(); ++t) {
    const uint32_t c = topology.component_of_triangle[t];
    is_turned[t] = is_turned_component[c];
    is_negated[t] = is_turned[t] && follow[c];
    if (!is_turned[t]) continue;
    std::swap(scene.triangle_positions[t].y, scene.triangle_positions[t].z);
    std::swap(scene.triangle_normals[t].y, scene.triangle_normals[t].z);
  }
  negate_normals(scene, is_negated);
  turn_texcoords(scene, is_turned);
  for (EdgeUse& use : topology.uses)
    if (is_turned[use.triangle]) use.reversed ^= 1;
}

void turn_inside_out_bodies(Scene& scene, Topology& topology, ThreadPool& pool, Warnings& warnings) {
  const std::vector<uint32_t> bodies = find_inside_out(scene, topology, pool);
  if (bodies.empty()) return;
  turn_components(scene, topology, bodies);
  const auto is_outward = [&](uint32_t c) { return topology.components[c].winding == Winding::outward; };
  const auto outward = std::count_if(bodies.begin(), bodies.end(), is_outward);
  const Component& first = topology.components[*std::find_if(bodies.begin(), bodies.end(), is_outward)];
  const size_t cavities = bodies.size() - static_cast<size_t>(outward);
  warnings.emplace_back(
      WarningCode::body_turned,
      fmt::format("{} closed bodies were wound inward and are turned outward{} (first: {} triangles of material {})",
                  outward, cavities > 0 ? fmt::format(", {} cavities in them the other way", cavities) : "",
                  first.triangles, in_quotes(scene.material_of(first.first_triangle).name)));
}

}  // namespace hybridrt
