#include "core/procedural/thin.h"

#include <algorithm>
#include <array>
#include <string>

#include "core/base/error.h"
#include "core/base/fixed_random.h"
#include "core/procedural/choose_mirrors.h"
#include "core/procedural/paint.h"
#include "core/procedural/thin_parts.h"

namespace hybridrt {
namespace {

constexpr double kHalf = 10;    // half the ground's side
constexpr double kAir = 0.004;  // between the ground and what stands on it

struct Paint {
  const char* name;
  vec3 kd;
};
constexpr Paint kSoil{"soil", {0.20f, 0.14f, 0.085f}}, kWood{"whitewash", {0.62f, 0.60f, 0.54f}},
    kSteel{"steel", {0.20f, 0.21f, 0.23f}}, kPost{"post", {0.24f, 0.15f, 0.08f}},
    kBrick{"brick", {0.55f, 0.16f, 0.10f}}, kSlate{"slate", {0.13f, 0.27f, 0.45f}},
    kOchre{"ochre", {0.62f, 0.38f, 0.10f}};
constexpr std::array<Paint, 3> kGrass = {
    {{"grass", {0.16f, 0.30f, 0.06f}}, {"grass_pale", {0.28f, 0.36f, 0.10f}}, {"grass_dark", {0.08f, 0.20f, 0.05f}}}};

/// A closed surface, in place.
struct Part {
  std::vector<Patch> patches;
  Paint paint;
  bool mirror = false;  ///< by design
};

dvec3 on_ground(double x, double z, double above = kAir) { return {x, ground_height(x, z) + above, z}; }

void add_fence(std::vector<Part>& parts) {
  constexpr double kZ = -3.2;
  for (int i = 0; i < 64; ++i) {
    const double x = -7.9 + 0.25 * i;
    const dvec3 foot = on_ground(x, kZ, 0.03);
    parts.push_back({box(foot - dvec3(0.06, 0, 0.015), dvec3(x + 0.06, 1.28, kZ + 0.015), 0.10), kWood});
  }
  for (const double y : {0.52, 1.02}) parts.push_back({box({-8, y, kZ - 0.06}, {8.1, y + 0.09, kZ - 0.019}), kWood});
}

/// Overhead wires on three poles, and a screen of thin wire.
void add_wires(std::vector<Part>& parts, int cells) {
  for (const double x : {-8.5, 0.3, 8.9}) {
    const dvec3 foot = on_ground(x, -1.2);
    parts.push_back({tube([=](double t) { return foot + t * dvec3(0, 2.9, 0); }, 0.055, 12, 1), kPost});
  }
  for (int i = 0; i < 6; ++i) {
    const double y = 2.15 + 0.11 * i, sag = 0.25 + 0.04 * (i % 3);
    // Past the poles, slightly in front of them.
    const auto path = [=](double t) {
      const double along = 2 * std::abs(2 * t - 1) - 1;  // -1 at the middle pole, 1 at the outer ends
      return dvec3(-9 + 18.2 * t, y - sag * (1 - along * along), -1.12);
    };
    parts.push_back({tube(path, 0.0035, 5, cells), kSteel});
  }
  constexpr double kLeft = -5.6, kScreenZ = 1.6, kPitch = 0.07;
  for (int i = 0; i < 30; ++i) {
    const dvec3 from = on_ground(kLeft + kPitch * i, kScreenZ, 0.05);
    parts.push_back(
        {tube([=](double t) { return dvec3(from.x, glm::mix(from.y, 1.35, t), from.z); }, 0.003, 5, 1), kSteel});
  }
  for (int i = 0; i < 16; ++i) {
    const double y = 0.22 + kPitch * i;
    parts.push_back({tube([=](double t) { return dvec3(kLeft - 0.05 + t * (29 * kPitch + 0.1), y, kScreenZ + 0.0075); },
                          0.003, 5, 1),
                     kSteel});
  }
}

/// A walkway's grating on four legs: bars one way, rods across them.
void add_grating(std::vector<Part>& parts) {
  constexpr double kX = 2.2, kZ = -0.1, kTop = 0.95, kWide = 3.2, kDeep = 2.0;
  for (int i = 0; i <= 40; ++i) {
    const double x = kX + kWide * i / 40;
    parts.push_back({box({x - 0.006, kTop - 0.07, kZ}, {x + 0.006, kTop, kZ + kDeep}), kSteel});
  }
  for (int i = 0; i <= 14; ++i) {
    const double z = kZ + 0.05 + (kDeep - 0.1) * i / 14;
    parts.push_back({box({kX - 0.03, kTop + 0.002, z - 0.005}, {kX + kWide + 0.03, kTop + 0.012, z + 0.005}), kSteel});
  }
  for (const double x : {kX + 0.04, kX + kWide - 0.04})
    for (const double z : {kZ + 0.06, kZ + kDeep - 0.06}) {
      const dvec3 foot = on_ground(x, z);
      parts.push_back(
          {tube([=](double t) { return dvec3(x, glm::mix(foot.y, kTop - 0.074, t), z); }, 0.03, 8, 1), kSteel});
    }
}

struct Round {
  double x, z, radius;
  Paint paint;
  bool mirror, is_ring;
};
constexpr Round kRounds[] = {{-1.6, 1.4, 0.55, kBrick, false, false},  {0.2, 3.0, 0.34, kSlate, true, false},
                             {-3.1, 3.6, 0.42, kOchre, false, true},   {1.1, 0.4, 0.48, kOchre, true, false},
                             {-6.4, -1.2, 0.70, kSlate, false, false}, {3.3, 3.4, 0.50, kBrick, false, true},
                             {6.6, 2.2, 0.62, kSlate, true, false},    {-0.6, -1.9, 0.45, kBrick, false, true}};

void add_rounds(std::vector<Part>& parts, int around) {
  for (const Round& r : kRounds) {
    const dvec3 middle = on_ground(r.x, r.z, 1.08 * r.radius + (r.is_ring ? 0.25 * r.radius : 0));
    Part part{r.is_ring ? ring(r.radius, 0.25 * r.radius, around, std::max(4, around / 3)) : ball(r.radius, around),
              r.paint, r.mirror};
    for (Patch& patch : part.patches)
      patch.at = [at = std::move(patch.at), middle](double u, double v) { return middle + at(u, v); };
    parts.push_back(std::move(part));
  }
}

std::vector<Part> make_parts(int64_t triangles) {
  const double finer = std::sqrt(static_cast<double>(triangles) / 500'000);
  const auto scaled = [finer](double at_default, int fewest) {
    return std::max(fewest, static_cast<int>(std::lround(at_default * finer)));
  };
  std::vector<Part> parts;
  parts.push_back({ground_slab(kHalf, scaled(120, 14)), kSoil});
  add_fence(parts);
  add_wires(parts, scaled(240, 24));
  add_grating(parts);
  add_rounds(parts, scaled(96, 12));
  return parts;
}

/// Blades in clumps, none inside the balls.
void add_grass(std::array<TriangleMesh, 2 * kGrass.size()>& meshes, int64_t blades, const char* is_mirror) {
  uint64_t state = 7;
  for (int64_t blade = 0; blade < blades; ++blade) {
    double x, z, clear;
    do {
      x = (kHalf - 0.5) * (2 * next_unit(state) - 1), z = (kHalf - 0.5) * (2 * next_unit(state) - 1);
      clear = 1;
      for (const Round& r : kRounds) clear = std::min(clear, std::hypot(x - r.x, z - r.z) - r.radius);
      // Thicker where two slow waves meet.
      const double clump = 0.5 + 0.5 * std::sin(1.7 * x + 0.6 * z) * std::sin(1.1 * z - 0.8 * x + 1);
      if (next_unit(state) > 0.25 + 0.75 * clump) clear = 0;
    } while (clear < 0.05);
    const double height = 0.16 + 0.34 * next_unit(state), turn_rad = 2 * kPi * next_unit(state);
    const double bent = height * (0.15 + 0.5 * next_unit(state)), toward = turn_rad + 0.6;
    const dvec3 lean(bent * std::cos(toward) + 0.05, -0.2 * bent, bent * std::sin(toward));
    const size_t tone = next_random(state) % kGrass.size();
    add_blade(meshes[2 * tone + is_mirror[blade]], on_ground(x, z), lean, height, 0.010 + 0.012 * next_unit(state),
              turn_rad);
  }
}

uint32_t find_material(Scene& scene, const Paint& paint, bool mirror) {
  const Material made = painted(paint.name, paint.kd, mirror);
  for (uint32_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].name == made.name) return i;
  scene.materials.push_back(made);
  return static_cast<uint32_t>(scene.materials.size() - 1);
}

}  // namespace

Scene make_thin(const ThinOptions& options) {
  const std::vector<Part> parts = make_parts(options.triangles);
  int64_t left = options.triangles;
  for (const Part& part : parts) left -= count_triangles(part.patches);
  const int64_t blades = std::max<int64_t>(0, left / kBladeTriangles);

  // Without a percentage the mirrors are those of the design.
  std::vector<char> is_mirror =
      choose_mirrors(static_cast<int>(parts.size() + blades), options.reflective_percent.value_or(0));
  for (size_t i = 0; i < parts.size(); ++i)
    if (!options.reflective_percent) is_mirror[i] = parts[i].mirror;

  Scene scene;
  for (size_t i = 0; i < parts.size(); ++i)
    add_mesh(scene, mesh_of(parts[i].patches), {}, find_material(scene, parts[i].paint, is_mirror[i]));
  std::array<TriangleMesh, 2 * kGrass.size()> grass;
  add_grass(grass, blades, is_mirror.data() + parts.size());
  for (size_t i = 0; i < grass.size(); ++i)
    if (!grass[i].positions.empty()) add_mesh(scene, grass[i], {}, find_material(scene, kGrass[i / 2], i % 2 != 0));
  scene.bounds = compute_bounds(scene);
  validate(scene);
  return scene;
}

SceneShot thin_shot() {
  SceneShot shot;
  Camera camera;
  camera.eye_world = {-2.2, 2.2, 9.0};
  camera.target_world = {-0.3, 0.55, 0.0};
  camera.fov_y_rad = 42 * kPi / 180;
  shot.camera = camera;
  shot.lights = {DirectionalLight{glm::normalize(dvec3(-0.75, 0.6, 0.4)), vec3(1)}};
  shot.background = vec3(0.42f, 0.55f, 0.72f);
  shot.ambient = vec3(0.18f, 0.20f, 0.23f);
  return shot;
}

}  // namespace hybridrt
