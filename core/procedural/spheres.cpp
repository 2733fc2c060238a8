#include "core/procedural/spheres.h"

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/base/fixed_random.h"
#include "core/procedural/choose_mirrors.h"
#include "core/procedural/paint.h"

namespace hybridrt {
namespace {

constexpr double kRadius = 0.48;  // balls are one unit apart
constexpr double kGap = 0.02;     // below them
constexpr double kMargin = 0.15;  // ground beyond the outermost balls
constexpr double kBallShare = 0.95;

struct Paint {
  const char* name;
  vec3 kd;
};
// Linear. Muted, of similar lightness, distinguishable with colour vision deficiencies too.
constexpr std::array<Paint, 5> kPaints = {{{"brick", {0.55f, 0.16f, 0.10f}},
                                           {"ochre", {0.62f, 0.38f, 0.10f}},
                                           {"moss", {0.20f, 0.36f, 0.12f}},
                                           {"slate", {0.13f, 0.27f, 0.45f}},
                                           {"chalk", {0.62f, 0.60f, 0.55f}}}};

/// Rings and segments whose 2 * segments * (rings - 1) triangles come closest to `triangles` from below,
/// among those with about twice as many segments as rings.
void choose_ball(SpheresPlan& plan, int64_t triangles) {
  int64_t best = 0;
  const int middle = std::max(3, static_cast<int>(std::sqrt(static_cast<double>(triangles) / 4)));
  for (int rings = std::max(3, middle * 9 / 10); rings <= middle * 11 / 10 + 1; ++rings) {
    const auto segments = static_cast<int>(triangles / (2 * (rings - 1)));
    const int64_t got = int64_t{2} * segments * (rings - 1);
    if (segments >= 4 && got > best) best = got, plan.rings = rings, plan.segments = segments;
  }
}

/// Cells of a nearly square grid, as close to `cells` as it gets.
void choose_ground(SpheresPlan& plan, int64_t cells) {
  int64_t best = std::numeric_limits<int64_t>::max();
  const int middle = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(cells))));
  for (int x = std::max(1, middle * 3 / 4); x <= middle; ++x) {
    const int z = std::max(1, static_cast<int>((cells + x / 2) / x));
    const int64_t off = std::abs(cells - int64_t{x} * z);
    if (off <= best) best = off, plan.ground_x = x, plan.ground_z = z;
  }
}

void add_triangle(Scene& scene, uvec3 positions, uvec3 normals, uint32_t material) {
  scene.triangle_positions.push_back(positions);
  scene.triangle_normals.push_back(normals);
  scene.triangle_materials.push_back(material);
}

void add_ground(Scene& scene, const SpheresPlan& plan, uint32_t material) {
  const double half = 0.5 * (plan.side - 1) + kRadius + kMargin;
  const auto first = static_cast<uint32_t>(scene.positions.size());
  const auto normal = static_cast<uint32_t>(scene.normals.size());
  scene.normals.emplace_back(0, 1, 0);
  for (int z = 0; z <= plan.ground_z; ++z)
    for (int x = 0; x <= plan.ground_x; ++x)
      scene.positions.emplace_back(half * (2.0 * x / plan.ground_x - 1), 0, half * (2.0 * z / plan.ground_z - 1));
  const auto row = static_cast<uint32_t>(plan.ground_x + 1);
  for (int z = 0; z < plan.ground_z; ++z)
    for (int x = 0; x < plan.ground_x; ++x) {
      const uint32_t a = first + z * row + x, b = a + 1, c = a + row, d = c + 1;
      add_triangle(scene, {a, c, b}, uvec3(normal), material);
      add_triangle(scene, {b, c, d}, uvec3(normal), material);
    }
}

/// Unit directions of a ball's vertices: the north pole, the rings downward, the south pole.
std::vector<vec3> ball_directions(const SpheresPlan& plan) {
  std::vector<vec3> directions = {vec3(0, 1, 0)};
  for (int ring = 1; ring < plan.rings; ++ring)
    for (int segment = 0; segment < plan.segments; ++segment) {
      const double theta_rad = kPi * ring / plan.rings, phi_rad = 2 * kPi * segment / plan.segments;
      directions.emplace_back(std::sin(theta_rad) * std::cos(phi_rad), std::cos(theta_rad),
                              -std::sin(theta_rad) * std::sin(phi_rad));
    }
  directions.emplace_back(0, -1, 0);
  return directions;
}

/// Indices into ball_directions().
std::vector<uvec3> ball_triangles(const SpheresPlan& plan) {
  std::vector<uvec3> triangles;
  const auto n = static_cast<uint32_t>(plan.segments), south = 1 + n * (plan.rings - 1);
  for (uint32_t i = 0; i < n; ++i) triangles.emplace_back(0, 1 + i, 1 + (i + 1) % n);
  for (uint32_t upper = 1; upper + n < south; upper += n)
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t j = (i + 1) % n, lower = upper + n;
      triangles.emplace_back(upper + i, lower + i, lower + j);
      triangles.emplace_back(upper + i, lower + j, upper + j);
    }
  for (uint32_t i = 0; i < n; ++i) triangles.emplace_back(south - n + i, south, south - n + (i + 1) % n);
  return triangles;
}

/// The material of each ball; adds those needed, in the order of first use.
std::vector<uint32_t> paint_balls(const SpheresPlan& plan, Scene& scene) {
  std::array<uint32_t, 2 * kPaints.size()> slots;
  slots.fill(kNoTriangle);
  std::vector<uint32_t> materials;
  uint64_t state = 5;
  for (int ball = 0; ball < plan.balls(); ++ball) {
    const size_t paint = next_random(state) % kPaints.size();
    const bool mirror = plan.is_mirror[ball];
    uint32_t& slot = slots[2 * paint + mirror];
    if (slot == kNoTriangle) {
      slot = static_cast<uint32_t>(scene.materials.size());
      scene.materials.push_back(painted(kPaints[paint].name, kPaints[paint].kd, mirror));
    }
    materials.push_back(slot);
  }
  return materials;
}

}  // namespace

SpheresPlan plan_spheres(const SpheresOptions& options) {
  SpheresPlan plan;
  // 10 x 10 balls at 500,000 triangles; thirty-two times the triangles give twice the side.
  const auto total = static_cast<double>(options.triangles);
  plan.side = std::max(2, static_cast<int>(std::lround(10 * std::pow(total / 500'000, 0.2))));
  choose_ball(plan, static_cast<int64_t>(kBallShare * total) / plan.balls());
  choose_ground(plan, (options.triangles - plan.balls() * plan.ball_triangles() + 1) / 2);

  plan.is_mirror = choose_mirrors(plan.balls(), options.reflective_percent);
  return plan;
}

Scene make_spheres(const SpheresOptions& options) {
  const SpheresPlan plan = plan_spheres(options);
  const std::vector<vec3> directions = ball_directions(plan);
  const std::vector<uvec3> triangles = ball_triangles(plan);

  Scene scene;
  scene.triangle_positions.reserve(plan.triangles());
  scene.triangle_normals.reserve(plan.triangles());
  scene.triangle_materials.reserve(plan.triangles());
  scene.materials.push_back(painted("ground", vec3(0.45f, 0.43f, 0.40f)));
  add_ground(scene, plan, 0);

  const std::vector<uint32_t> materials = paint_balls(plan, scene);
  const auto first_normal = static_cast<uint32_t>(scene.normals.size());
  scene.normals.insert(scene.normals.end(), directions.begin(), directions.end());
  for (int ball = 0; ball < plan.balls(); ++ball) {
    const dvec3 center(ball % plan.side - 0.5 * (plan.side - 1), kGap + kRadius,
                       ball / plan.side - 0.5 * (plan.side - 1));
    const auto first = static_cast<uint32_t>(scene.positions.size());
    for (const vec3& direction : directions) scene.positions.emplace_back(center + kRadius * dvec3(direction));
    for (const uvec3& t : triangles) add_triangle(scene, t + first, t + first_normal, materials[ball]);
  }
  scene.bounds = compute_bounds(scene);
  validate(scene);
  return scene;
}

}  // namespace hybridrt
