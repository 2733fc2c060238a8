#include "core/procedural/double_mesh.h"

#include <array>

#include "core/base/error.h"
#include "core/scene/scene_origin.h"

namespace hybridrt {
namespace {

void add_triangle(DoubleMesh& mesh, uvec3 positions, uvec3 normals, uint32_t material) {
  mesh.triangle_positions.push_back(positions);
  mesh.triangle_normals.push_back(normals);
  mesh.triangle_materials.push_back(material);
}

}  // namespace

uint32_t DoubleMesh::add(const Material& material) {
  materials.push_back(material);
  return static_cast<uint32_t>(materials.size() - 1);
}

void DoubleMesh::add_sheet(const dvec3& corner, const dvec3& u, const dvec3& v, int cells_u, int cells_v,
                           uint32_t material, uint32_t other_material) {
  const auto first = static_cast<uint32_t>(positions.size());
  const auto normal = static_cast<uint32_t>(normals.size());
  normals.emplace_back(glm::normalize(glm::cross(u, v)));
  for (int j = 0; j <= cells_v; ++j)
    for (int i = 0; i <= cells_u; ++i)
      positions.push_back(corner + static_cast<double>(i) / cells_u * u + static_cast<double>(j) / cells_v * v);
  const auto row = static_cast<uint32_t>(cells_u + 1);
  for (int j = 0; j < cells_v; ++j)
    for (int i = 0; i < cells_u; ++i) {
      const uint32_t a = first + j * row + i, b = a + 1, c = a + row, d = c + 1;
      const uint32_t cell_material = (i + j) % 2 ? other_material : material;
      add_triangle(*this, {a, b, d}, uvec3(normal), cell_material);
      add_triangle(*this, {a, d, c}, uvec3(normal), cell_material);
    }
}

void DoubleMesh::add_hexahedron(const dvec3 (&corners)[8], uint32_t material) {
  const auto first = static_cast<uint32_t>(positions.size());
  positions.insert(positions.end(), std::begin(corners), std::end(corners));
  constexpr std::array<uint32_t, 4> kSides[] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (const auto& [a, b, c, d] : kSides) {
    const uvec3 normal(static_cast<uint32_t>(normals.size()));
    normals.emplace_back(glm::normalize(glm::cross(corners[c] - corners[a], corners[d] - corners[b])));
    add_triangle(*this, first + uvec3(a, b, c), normal, material);
    add_triangle(*this, first + uvec3(a, c, d), normal, material);
  }
}

void DoubleMesh::add_box(const dvec3& lo, const dvec3& hi, uint32_t material) {
  add_hexahedron({lo,
                  {hi.x, lo.y, lo.z},
                  {hi.x, hi.y, lo.z},
                  {lo.x, hi.y, lo.z},
                  {lo.x, lo.y, hi.z},
                  {hi.x, lo.y, hi.z},
                  hi,
                  {lo.x, hi.y, hi.z}},
                 material);
}

void DoubleMesh::add_ball(const dvec3& center, double radius, int segments, uint32_t material) {
  const int rings = std::max(2, segments / 2);
  const auto first = static_cast<uint32_t>(positions.size()), first_normal = static_cast<uint32_t>(normals.size());
  const auto vertex = [&](double theta_rad, double phi_rad) {
    const dvec3 direction(std::sin(theta_rad) * std::cos(phi_rad), std::cos(theta_rad),
                          -std::sin(theta_rad) * std::sin(phi_rad));
    positions.push_back(center + radius * direction);
    normals.emplace_back(direction);
  };
  vertex(0, 0);
  for (int ring = 1; ring < rings; ++ring)
    for (int segment = 0; segment < segments; ++segment) vertex(kPi * ring / rings, 2 * kPi * segment / segments);
  vertex(kPi, 0);
  const auto n = static_cast<uint32_t>(segments), south = 1 + n * static_cast<uint32_t>(rings - 1);
  const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
    add_triangle(*this, first + uvec3(a, b, c), first_normal + uvec3(a, b, c), material);
  };
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    triangle(0, 1 + i, 1 + j);
    for (uint32_t upper = 1; upper + n < south; upper += n) {
      triangle(upper + i, upper + n + i, upper + n + j);
      triangle(upper + i, upper + n + j, upper + j);
    }
    triangle(south - n + i, south, south - n + j);
  }
}

void DoubleMesh::place(double scale, const dvec3& offset) {
  for (dvec3& p : positions) p = scale * p + offset;
}

Scene scene_of(const DoubleMesh& mesh) {
  WorldBox box;
  for (const dvec3& p : mesh.positions) box.grow(p);
  Scene scene;
  scene.origin_world = choose_scene_origin(box);
  for (const dvec3& p : mesh.positions) scene.positions.emplace_back(p - scene.origin_world);
  scene.normals = mesh.normals;
  scene.materials = mesh.materials;
  for (size_t t = 0; t < mesh.triangle_positions.size(); ++t) {
    const uvec3& corners = mesh.triangle_positions[t];
    const dvec3 a(scene.positions[corners.x]), b(scene.positions[corners.y]), c(scene.positions[corners.z]);
    if (glm::cross(b - a, c - a) == dvec3(0)) continue;
    scene.triangle_positions.push_back(corners);
    scene.triangle_normals.push_back(mesh.triangle_normals[t]);
    scene.triangle_materials.push_back(mesh.triangle_materials[t]);
  }
  if (scene.triangle_positions.empty())
    throw error(ErrorKind::usage, "the scene is so small and far away that nothing is left of it in single precision");
  scene.bounds = compute_bounds(scene);
  validate(scene);
  return scene;
}

}  // namespace hybridrt
