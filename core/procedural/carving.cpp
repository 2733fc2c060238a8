#include "core/procedural/carving.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace hybridrt {
namespace {

constexpr double kSpacingPerEdge = 1.35;  // spacing of the lattice's points

/// Two cubic lattices, the second in the middle of the first one's cells.
class Lattice {
 public:
  Lattice(const Solid& solid, const dvec3& lo, const dvec3& hi, double spacing)
      : lo_(lo - 1.5 * spacing), spacing_(spacing) {
    for (int axis = 0; axis < 3; ++axis) size_[axis] = static_cast<int>(std::ceil((hi[axis] - lo[axis]) / spacing)) + 4;
    values_.resize(size_t{2} * size_[0] * size_[1] * size_[2], 1.0f);
    fill(solid);
  }
  int size(int axis) const { return size_[axis]; }
  uint64_t id(int which, int x, int y, int z) const {
    return ((static_cast<uint64_t>(z) * size_[1] + y) * size_[0] + x) * 2 + which;
  }
  float value(uint64_t id) const { return values_[id]; }
  dvec3 position(uint64_t id) const {
    const uint64_t cell = id / 2;
    const dvec3 corner(static_cast<double>(cell % size_[0]), static_cast<double>(cell / size_[0] % size_[1]),
                       static_cast<double>(cell / size_[0] / size_[1]));
    return lo_ + spacing_ * (corner + (id % 2 ? 0.5 : 0.0));
  }

 private:
  /// Blocks far from the surface get one value.
  void fill(const Solid& solid) {
    constexpr int kBlock = 6;
    const double reach = 2.5 * 0.87 * (kBlock + 1) * spacing_;
    for (int bz = 0; bz < size_[2]; bz += kBlock)
      for (int by = 0; by < size_[1]; by += kBlock)
        for (int bx = 0; bx < size_[0]; bx += kBlock) {
          const double middle = solid(lo_ + spacing_ * (dvec3(bx, by, bz) + 0.5 * kBlock));
          for (int z = bz; z < std::min(bz + kBlock, size_[2]); ++z)
            for (int y = by; y < std::min(by + kBlock, size_[1]); ++y)
              for (int x = bx; x < std::min(bx + kBlock, size_[0]); ++x)
                for (int which = 0; which < 2; ++which) {
                  const uint64_t at = id(which, x, y, z);
                  const double value = std::abs(middle) > reach ? middle : solid(position(at));
                  values_[at] = static_cast<float>(value == 0 ? 1e-9 : value);
                }
        }
  }

  dvec3 lo_;
  double spacing_;
  std::array<int, 3> size_{};
  std::vector<float> values_;
};

class Polygoniser {
 public:
  explicit Polygoniser(const Lattice& lattice) : lattice_(lattice) {}

  void tetrahedron(std::array<uint64_t, 4> corners) {
    int inside = 0;
    for (const uint64_t c : corners) inside += lattice_.value(c) < 0;
    if (inside == 0 || inside == 4) return;
    std::partition(corners.begin(), corners.end(), [&](uint64_t c) { return lattice_.value(c) < 0; });
    const auto& [a, b, c, d] = corners;
    const dvec3 from = lattice_.position(a);
    const bool mirrored =
        glm::dot(lattice_.position(d) - from, glm::cross(lattice_.position(b) - from, lattice_.position(c) - from)) < 0;
    if (inside == 1) {
      add(mirrored, cut(a, b), cut(a, c), cut(a, d));
    } else if (inside == 3) {
      add(mirrored, cut(a, d), cut(b, d), cut(c, d));
    } else {
      const uint32_t ac = cut(a, c), ad = cut(a, d), bc = cut(b, c), bd = cut(b, d);
      add(mirrored, ac, ad, bd);
      add(mirrored, ac, bd, bc);
    }
  }
  std::vector<dvec3> positions;
  std::vector<uvec3> triangles;

 private:
  uint32_t cut(uint64_t in, uint64_t out) {
    const auto [found, is_new] = vertices_.try_emplace(in << 32 | out, static_cast<uint32_t>(positions.size()));
    if (is_new) {
      const double a = lattice_.value(in), b = lattice_.value(out);
      // Stays off the ends, where several vertices would meet in a point.
      const double along = std::clamp(a / (a - b), 0.02, 0.98);
      positions.push_back(glm::mix(lattice_.position(in), lattice_.position(out), along));
    }
    return found->second;
  }
  void add(bool mirrored, uint32_t a, uint32_t b, uint32_t c) {
    triangles.push_back(mirrored ? uvec3(a, c, b) : uvec3(a, b, c));
  }

  const Lattice& lattice_;
  std::unordered_map<uint64_t, uint32_t> vertices_;
};

void visit_tetrahedra(const Lattice& lattice, Polygoniser& polygoniser) {
  for (int z = 0; z + 2 < lattice.size(2); ++z)
    for (int y = 0; y + 2 < lattice.size(1); ++y)
      for (int x = 0; x + 2 < lattice.size(0); ++x)
        for (int axis = 0; axis < 3; ++axis) {
          // Goes around the face that this cell shares with the next one along the axis.
          const int e[3] = {axis == 0, axis == 1, axis == 2}, f[3] = {e[2], e[0], e[1]}, g[3] = {e[1], e[2], e[0]};
          const uint64_t center = lattice.id(1, x, y, z), next = lattice.id(1, x + e[0], y + e[1], z + e[2]);
          uint64_t ring[5];
          for (int k = 0; k < 5; ++k) {
            const int i = k == 1 || k == 2, j = k == 2 || k == 3;
            ring[k] = lattice.id(0, x + e[0] + i * f[0] + j * g[0], y + e[1] + i * f[1] + j * g[1],
                                 z + e[2] + i * f[2] + j * g[2]);
          }
          for (int k = 0; k < 4; ++k) polygoniser.tetrahedron({center, next, ring[k], ring[k + 1]});
        }
}

/// `value`: `solid` at `p`.
dvec3 gradient(const Solid& solid, const dvec3& p, double value, double step) {
  return dvec3(solid(p + dvec3(step, 0, 0)) - value, solid(p + dvec3(0, step, 0)) - value,
               solid(p + dvec3(0, 0, step)) - value) /
         step;
}

dvec3 normal_or(const dvec3& v, const dvec3& otherwise) {
  const double length = glm::length(v);
  return length > 1e-12 ? v / length : otherwise;
}

/// Evens out the triangles: moves each vertex along the surface toward the middle of its neighbours, then back onto it.
/// Returns the normals.
std::vector<dvec3> relax(const Solid& solid, double edge, const std::vector<uvec3>& triangles,
                         std::vector<dvec3>& positions) {
  constexpr int kRounds = 6;
  const double reach = 0.03 * edge;
  std::vector<dvec3> normals(positions.size()), sums(positions.size());
  std::vector<int> counts(positions.size());
  for (int round = 0; round <= kRounds; ++round) {
    std::fill(sums.begin(), sums.end(), dvec3(0));
    std::fill(counts.begin(), counts.end(), 0);
    for (const uvec3& t : triangles)
      for (int k = 0; k < 3; ++k) sums[t[k]] += positions[t[(k + 1) % 3]], ++counts[t[k]];
    for (size_t i = 0; i < positions.size(); ++i) {
      dvec3& p = positions[i];
      if (round > 0 && round < kRounds) {
        const dvec3 pull = sums[i] / static_cast<double>(counts[i]) - p;
        p += 0.6 * (pull - glm::dot(pull, normals[i]) * normals[i]);
      }
      const double value = solid(p);
      const dvec3 slope = gradient(solid, p, value, reach);
      normals[i] = normal_or(slope, dvec3(0, 1, 0));
      if (round < kRounds)
        p -= slope * std::clamp(value / std::max(glm::dot(slope, slope), 0.25), -0.5 * edge, 0.5 * edge);
    }
  }
  return normals;
}

}  // namespace

TriangleMesh carve(const Solid& solid, const dvec3& lo, const dvec3& hi, double edge) {
  const Lattice lattice(solid, lo, hi, kSpacingPerEdge * edge);
  Polygoniser polygoniser(lattice);
  visit_tetrahedra(lattice, polygoniser);
  const std::vector<dvec3> normals = relax(solid, edge, polygoniser.triangles, polygoniser.positions);

  TriangleMesh mesh;
  for (const dvec3& p : polygoniser.positions) mesh.positions.emplace_back(p);
  for (const dvec3& n : normals) mesh.normals.emplace_back(n);
  mesh.triangle_positions = polygoniser.triangles;
  mesh.triangle_normals = polygoniser.triangles;
  use_face_normals_where_others_fail(mesh);
  return mesh;
}

double smooth_union(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - 0.25 * h * h * blend;
}

double smooth_cut(double a, double b, double blend) { return -smooth_union(-a, b, blend); }

double ellipsoid(const dvec3& p, const dvec3& center, const dvec3& radii) {
  const dvec3 q = p - center;
  const double k0 = glm::length(q / radii), k1 = glm::length(q / (radii * radii));
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}

double round_cone(const dvec3& p, const dvec3& a, const dvec3& b, double radius_a, double radius_b) {
  const dvec3 axis = b - a;
  const double along = std::clamp(glm::dot(p - a, axis) / glm::dot(axis, axis), 0.0, 1.0);
  return glm::distance(p, a + along * axis) - glm::mix(radius_a, radius_b, along);
}

}  // namespace hybridrt
