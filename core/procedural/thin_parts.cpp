#include "core/procedural/thin_parts.h"

namespace hybridrt {

double ground_height(double x, double z) {
  return 0.22 * std::sin(0.55 * x + 0.8) * std::cos(0.42 * z) + 0.07 * std::sin(1.3 * z - 0.6 * x);
}

std::vector<Patch> ground_slab(double half, int cells) {
  constexpr double kBottom = -0.9;
  std::vector<Patch> patches;
  const auto add = [&](int rows, int columns, std::function<dvec3(double, double)> at) {
    Patch patch;
    patch.rows = rows, patch.columns = columns, patch.at = std::move(at);
    patches.push_back(std::move(patch));
  };
  const auto across = [half](double t) { return half * (2 * t - 1); };
  const auto top = [=](double x, double z) { return dvec3(x, ground_height(x, z), z); };
  add(cells, cells, [=](double u, double v) { return top(across(v), across(u)); });
  add(cells, cells, [=](double u, double v) { return dvec3(across(v), kBottom, across(1 - u)); });
  // The four sides, from the bottom up.
  const auto side = [&](std::function<dvec3(double)> edge) {
    add(1, cells, [edge](double u, double v) {
      const dvec3 p = edge(v);
      return dvec3(p.x, glm::mix(kBottom, p.y, u), p.z);
    });
  };
  side([=](double v) { return top(across(1 - v), half); });
  side([=](double v) { return top(across(v), -half); });
  side([=](double v) { return top(half, across(v)); });
  side([=](double v) { return top(-half, across(1 - v)); });
  return patches;
}

std::vector<Patch> box(const dvec3& lo, const dvec3& hi, double point) {
  const double size_y = hi.y - lo.y, shoulder = point / size_y;
  Profile p({0, 0});
  p.line({1, 0}).line({1, 1 - shoulder}).line({0, 1});
  std::vector<Patch> patches = turned(p, square(), {1e3, 0});
  for (Patch& patch : patches)
    patch.at = [at = std::move(patch.at), lo, size = hi - lo](double u, double v) {
      return lo + size * (at(u, v) * dvec3(0.5, 1, 0.5) + dvec3(0.5, 0, 0.5));
    };
  return patches;
}

std::vector<Patch> tube(std::function<dvec3(double)> path, double radius, int sides, int cells) {
  const auto surface = [path = std::move(path), radius](double along, double v, double width) {
    const dvec3 middle = path(along);
    const dvec3 way = glm::normalize(path(along + 1e-4) - path(along - 1e-4));
    const dvec3 aside = glm::normalize(glm::cross(way, std::abs(way.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
    const dvec3 upward = glm::cross(aside, way);
    const double angle = -2 * kPi * v;
    return middle + width * radius * (std::cos(angle) * upward + std::sin(angle) * aside);
  };
  std::vector<Patch> patches(3);
  for (Patch& patch : patches) patch.columns = sides;
  patches[0].point_at_u0 = true;
  patches[0].at = [=](double u, double v) { return surface(0, v, u); };
  patches[1].rows = cells;
  patches[1].at = [=](double u, double v) { return surface(u, v, 1); };
  patches[2].point_at_u1 = true;
  patches[2].at = [=](double u, double v) { return surface(1, v, 1 - u); };
  return patches;
}

std::vector<Patch> ring(double radius, double thickness, int around, int across) {
  Patch patch;
  patch.rows = across, patch.columns = around;
  patch.at = [=](double u, double v) {
    const double r = radius + thickness * std::cos(2 * kPi * u), angle = 2 * kPi * v;
    return dvec3(r * std::cos(angle), -r * std::sin(angle), thickness * std::sin(2 * kPi * u));
  };
  return {patch};
}

std::vector<Patch> ball(double radius, int around) {
  Profile p({0, -radius});
  p.arc({0, radius}, 1);
  std::vector<Patch> patches = turned(p, circle(), {static_cast<double>(around), 0.0});
  patches[0].rows = std::max(3, around / 2);
  return patches;
}

void add_blade(TriangleMesh& mesh, const dvec3& root, const dvec3& lean, double height, double width, double turn_rad) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  constexpr double kJoints[] = {0, 0.38, 0.74}, kWidths[] = {1, 0.8, 0.45};
  for (int joint = 0; joint < 3; ++joint) {
    const double t = kJoints[joint];
    const dvec3 middle = root + dvec3(0, height * t, 0) + t * t * lean;
    for (int k = 0; k < 3; ++k) {
      const double angle = turn_rad + 2 * kPi * k / 3;
      mesh.positions.emplace_back(middle + 0.5 * width * kWidths[joint] * dvec3(std::cos(angle), 0, -std::sin(angle)));
    }
  }
  mesh.positions.emplace_back(root + dvec3(0, height, 0) + lean);
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    const uvec3 t(first + a, first + b, first + c);
    const dvec3 p(mesh.positions[t.x]), q(mesh.positions[t.y]), r(mesh.positions[t.z]);
    mesh.triangle_positions.push_back(t);
    mesh.triangle_normals.emplace_back(static_cast<uint32_t>(mesh.normals.size()));
    mesh.normals.emplace_back(glm::normalize(glm::cross(q - p, r - p)));
  };
  add(0, 2, 1);
  for (uint32_t joint = 0; joint < 6; joint += 3)
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t a = joint + k, b = joint + (k + 1) % 3;
      add(a, b, b + 3);
      add(a, b + 3, a + 3);
    }
  for (uint32_t k = 0; k < 3; ++k) add(6 + k, 6 + (k + 1) % 3, 9);
}

}  // namespace hybridrt
