#include "core/procedural/patch_mesh.h"

#include "core/mesh/weld.h"

namespace hybridrt {
namespace {

/// Rounds to multiples of 2^-20, which floats below 8 hold exactly: what differs by rounding becomes equal.
vec3 snapped(const dvec3& p) { return vec3(glm::round(p * 0x1p20) * 0x1p-20) + vec3(0); }

/// By central differences, a little inside the patch, where poles have a normal too.
vec3 normal_at(const Patch& patch, double u, double v) {
  constexpr double kInside = 2e-4, kStep = 1e-4;
  u = std::clamp(u, kInside, 1 - kInside), v = std::clamp(v, kInside, 1 - kInside);
  const dvec3 along_u = patch.at(u + kStep, v) - patch.at(u - kStep, v);
  const dvec3 along_v = patch.at(u, v + kStep) - patch.at(u, v - kStep);
  return vec3(glm::normalize(glm::cross(along_u, along_v)));
}

void append_patch(TriangleMesh& mesh, const Patch& patch) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (int row = 0; row <= patch.rows; ++row)
    for (int column = 0; column <= patch.columns; ++column) {
      const double u = static_cast<double>(row) / patch.rows, v = static_cast<double>(column) / patch.columns;
      mesh.positions.push_back(snapped(patch.at(u, v)));
      mesh.normals.push_back(normal_at(patch, u, v));
    }
  const auto stride = static_cast<uint32_t>(patch.columns + 1);
  for (int row = 0; row < patch.rows; ++row)
    for (int column = 0; column < patch.columns; ++column) {
      const uint32_t a = first + row * stride + column, b = a + 1, c = a + stride, d = c + 1;
      // At a pole one of the two has no area; it is dropped after welding.
      mesh.triangle_normals.emplace_back(a, c, d);
      mesh.triangle_normals.emplace_back(a, d, b);
    }
}

bool is_degenerate(const uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; }

}  // namespace

int64_t count_triangles(std::span<const Patch> patches) {
  int64_t count = 0;
  for (const Patch& patch : patches) count += patch.triangles();
  return count;
}

TriangleMesh mesh_of(std::span<const Patch> patches) {
  TriangleMesh mesh;
  for (const Patch& patch : patches) append_patch(mesh, patch);

  ThreadPool alone(1);
  // Keeps each position once, in the order of first use.
  const std::vector<uint32_t> same = weld_positions(mesh.positions, alone);
  std::vector<uint32_t> kept(same.size());
  std::vector<vec3> positions;
  for (uint32_t i = 0; i < same.size(); ++i) {
    kept[i] = same[i] == i ? static_cast<uint32_t>(positions.size()) : kept[same[i]];
    if (same[i] == i) positions.push_back(mesh.positions[i]);
  }
  mesh.positions = std::move(positions);

  size_t triangles = 0;
  for (const uvec3 t : std::vector<uvec3>(mesh.triangle_normals)) {
    const uvec3 welded(kept[t.x], kept[t.y], kept[t.z]);
    if (is_degenerate(welded)) continue;
    mesh.triangle_positions.push_back(welded);
    mesh.triangle_normals[triangles++] = t;
  }
  mesh.triangle_normals.resize(triangles);
  use_face_normals_where_others_fail(mesh);
  return mesh;
}

void use_face_normals_where_others_fail(TriangleMesh& mesh) {
  for (size_t t = 0; t < mesh.triangle_positions.size(); ++t) {
    const uvec3 p = mesh.triangle_positions[t];
    const dvec3 a(mesh.positions[p.x]), b(mesh.positions[p.y]), c(mesh.positions[p.z]);
    const dvec3 face = glm::normalize(glm::cross(b - a, c - a));
    uint32_t own = kNoTriangle;
    for (int k = 0; k < 3; ++k) {
      uint32_t& normal = mesh.triangle_normals[t][k];
      if (glm::dot(face, dvec3(mesh.normals[normal])) > 0.02) continue;
      if (own == kNoTriangle) own = static_cast<uint32_t>(mesh.normals.size()), mesh.normals.emplace_back(face);
      normal = own;
    }
  }
}

void add_mesh(Scene& scene, const TriangleMesh& mesh, const Placement& placement, uint32_t material) {
  const auto first = static_cast<uint32_t>(scene.positions.size());
  const auto first_normal = static_cast<uint32_t>(scene.normals.size());
  const double c = std::cos(placement.turn_rad), s = std::sin(placement.turn_rad);
  const auto turned = [&](const dvec3& v) { return dvec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x); };
  for (const vec3& p : mesh.positions)
    scene.positions.emplace_back(vec3(turned(dvec3(p)) + placement.position) + vec3(0));
  for (const vec3& n : mesh.normals) scene.normals.emplace_back(vec3(turned(dvec3(n))) + vec3(0));
  for (const uvec3& t : mesh.triangle_positions) scene.triangle_positions.push_back(t + first);
  for (const uvec3& t : mesh.triangle_normals) scene.triangle_normals.push_back(t + first_normal);
  scene.triangle_materials.insert(scene.triangle_materials.end(), mesh.triangle_positions.size(), material);
}

}  // namespace hybridrt
