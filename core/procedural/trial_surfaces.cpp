// Trial scenes about surfaces, and eyes close to them.

#include "core/procedural/trial_parts.h"
#include "core/procedural/trial_scenes.h"

namespace hybridrt {
namespace {

constexpr SceneParameter kRatio{"ratio", "of a sliver's length and width", 1, 1e9, 100};
constexpr SceneParameter kSlivers[] = {kRatio};
constexpr double kWidest = 0.08, kLongest = 3;  // of a sliver

Scene make_slivers(const SceneValues& values) {
  DoubleMesh mesh;
  add_floor(mesh, 2.5, 5);
  const uint32_t wide = mesh.add(painted("red", kRed)), narrow = mesh.add(painted("blue", kBlue));
  const double ratio = value_of(values, kRatio);
  const int rows = std::max(1, static_cast<int>(std::lround(kLongest / (kWidest * ratio))));
  const double width = kLongest / rows / ratio, pitch = 0.16;
  const dvec3 deep(0, 0, kLongest);
  for (int i = 0; i < 18; ++i) {
    const auto strip = [&](double from, double to, int cells, uint32_t material) {
      const dvec3 corner(from, 0.7 + 0.2 * from, -kLongest / 2), end(to, 0.7 + 0.2 * to, -kLongest / 2);
      mesh.add_sheet(corner, deep, end - corner, cells, 1, material, material);
    };
    const double from = -1.44 + pitch * i;
    strip(from, from + width, rows, narrow);
    strip(from + width, from + pitch, 1, wide);
  }
  return scene_of(mesh);
}

SceneShot slivers_shot(const SceneValues&) { return trial_shot({1.2, 3, 4}, {0, 0.4, 0}, 40, {-0.5, 0.8, 0.35}); }

constexpr SceneParameter kGap{"gap", "between the two sheets", 0, 0.5, 0.01};
constexpr SceneParameter kSheets[] = {kGap};

Scene make_sheets(const SceneValues& values) {
  DoubleMesh mesh;
  add_floor(mesh, 2.5, 5);
  const uint32_t red = mesh.add(painted("red", kRed)), blue = mesh.add(painted("blue", kBlue));
  const double gap = value_of(values, kGap);
  mesh.add_sheet({-1.3, 0.5, 1}, {1.7, 0, 0}, {0, 0, -2}, 3, red);
  mesh.add_sheet({-0.4, 0.5 + gap, 0.7}, {1.7, 0, 0}, {0, 0, -1.9}, 4, blue);
  return scene_of(mesh);
}

SceneShot sheets_shot(const SceneValues&) { return trial_shot({0.8, 2.6, 4}, {0, 0.2, 0}, 40, {-0.5, 0.8, 0.35}); }

constexpr SceneParameter kAbove{"above", "height of the eye above the plane", 0, 10, {}},
    kToCorner{"to-corner", "distance of the eye from a corner of the box", 0, 10, {}},
    kToWall{"to-wall", "distance of the eye from a side of the box", 0, 10, {}},
    kInGlass{"in-glass", "depth of the eye below the glass's surface", 0, 1, {}};
constexpr SceneParameter kEye[] = {kAbove, kToCorner, kToWall, kInGlass};

Scene make_eye(const SceneValues& values) {
  DoubleMesh mesh;
  add_floor(mesh, 5, 20);
  mesh.add_ball({0, 0.52, 0}, 0.5, 64, mesh.add(painted("red", kRed)));
  mesh.add_box({1, 0.02, -0.5}, {2, 1.02, 0.5}, mesh.add(painted("blue", kBlue)));
  mesh.add_box({-2.5, 0.02, -1}, {-1, 1.52, 0.5},
               mesh.add(is_given(values, kInGlass) ? glass(1.5) : painted("ochre", kOchre)));
  return scene_of(mesh);
}

SceneShot eye_shot(const SceneValues& values) {
  dvec3 eye(0.3, 1.2, 4), target(0, 0.5, 0);
  if (is_given(values, kAbove)) eye = {0.3, value_of(values, kAbove), 3}, target = {0.3, eye.y, 0};
  if (is_given(values, kToCorner))
    target = {2, 1.02, 0.5}, eye = target + value_of(values, kToCorner) * dvec3(0.64, 0.48, 0.6);
  if (is_given(values, kToWall)) eye = {2, 0.5, 0.5 + value_of(values, kToWall)}, target = {2, 0.5, -1};
  if (is_given(values, kInGlass)) eye = {-1.75, 1.52 - value_of(values, kInGlass), -0.25}, target = {0, 0.6, 0};
  return trial_shot(eye, target, 45, {-0.5, 0.8, 0.35});
}

}  // namespace

ProceduralScene slivers_scene() {
  return {"slivers", "a sheet of wide and of narrow triangles", kSlivers, make_slivers, slivers_shot};
}

ProceduralScene sheets_scene() {
  return {"sheets", "two sheets that overlap, one closely above the other", kSheets, make_sheets, sheets_shot};
}

ProceduralScene eye_scene() {
  return {"eye", "a ball and two boxes seen from up close, one of them glass for an eye in it", kEye, make_eye,
          eye_shot};
}

}  // namespace hybridrt
