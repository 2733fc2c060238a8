#include "core/render/default_view.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sstream>

#include "core/mesh/inside_out.h"
#include "core/render/default_light.h"
#include "core/render/room.h"
#include "core/scene/view.h"
#include "core/trace/embree_caster.h"
#include "tests/support/load_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

const char* const kCorners = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
const char* const kFiveWallsInward = "f 1 2 3 4\nf 1 4 8 5\nf 2 6 7 3\nf 1 5 6 2\nf 4 3 7 8\n";  // open at z = 1
const char* const kFrontWallInward = "f 5 8 7 6\n";
const char* const kStool =
    "v .3 -1 .3\nv .5 -1 .3\nv .4 -1 .5\nv .4 -.8 .4\nf 9 10 11\nf 9 12 10\nf 10 12 11\nf 11 12 9\n";

DefaultView view_of(const std::string& argument) {
  ThreadPool pool(1);
  Warnings warnings;
  Scene scene = load_scene(argument, pool, warnings);
  Topology topology = build_topology(scene, pool);
  turn_inside_out_bodies(scene, topology, pool, warnings);
  return choose_default_view({scene, topology, scene.bounds, *make_embree_caster(scene, 1)}, 4.0 / 3, 0.8);
}

DefaultView view_of_obj(const std::string& text) {
  const TemporaryFolder folder;
  return view_of(folder.write("room.obj", text).string());
}

TEST(DefaultView, GoesAroundThings) {
  for (const char* scene :
       {"scene:spheres,triangles=2000", "scene:chess,triangles=20000", "scene:thin,triangles=20000"})
    EXPECT_EQ(view_of(scene).surroundings, Surroundings::outside) << scene;
}

TEST(DefaultView, LooksIntoARoomFromItsOpenSide) {
  const DefaultView view = view_of_obj(std::string(kCorners) + kFiveWallsInward);
  EXPECT_EQ(view.surroundings, Surroundings::open);
  for (double fraction : {0.0, 0.5, 1.0}) {
    const Camera camera = camera_on_orbit(view.orbit, fraction);
    EXPECT_GT(camera.eye_world.z, 1);
    EXPECT_LT(std::abs(camera.eye_world.x), camera.eye_world.z);
  }
}

TEST(DefaultView, StandsInAClosedRoomWithALightOfItsOwn) {
  const DefaultView view = view_of_obj(std::string(kCorners) + kFiveWallsInward + kFrontWallInward + kStool);
  EXPECT_EQ(view.surroundings, Surroundings::inside);
  const Camera camera = camera_on_orbit(view.orbit, 0.3);
  for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(camera.eye_world[axis]), 1);
  const DirectionalLight light = default_light(view.surroundings, camera, vec3(0.15f));
  EXPECT_FALSE(light.casts_shadow);
  EXPECT_GT(glm::dot(light.toward, camera.eye_world - camera.target_world), 0) << "from behind the camera";
}

/// Boxes as an OBJ.
struct Boxes {
  std::ostringstream text;
  int vertices = 0;

  /// `reversed`: a bit for each of the sides that is wound inward.
  Boxes& add(const vec3& lo, const vec3& hi, int reversed = 0) {
    constexpr int kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int i = 0; i < 8; ++i)
      text << "v " << (i & 1 ? hi.x : lo.x) << ' ' << (i & 2 ? hi.y : lo.y) << ' ' << (i & 4 ? hi.z : lo.z) << '\n';
    for (int side = 0; side < 6; ++side) {
      text << 'f';
      for (int k = 0; k < 4; ++k) text << ' ' << vertices + 1 + kSides[side][reversed >> side & 1 ? 3 - k : k];
      text << '\n';
    }
    vertices += 8;
    return *this;
  }
  Surroundings surroundings() const { return view_of_obj(text.str()).surroundings; }
};
constexpr int kAllSides = 63;

TEST(DefaultView, StaysOutsideOfWhatIsOnlyInsideOut) {
  EXPECT_EQ(Boxes().add(vec3(-1), vec3(1), kAllSides).surroundings(), Surroundings::outside) << "an empty box";
  for (const int reversed : {kAllSides, 0b101111, 0b111001}) {
    Boxes town;
    for (int x = 0; x < 5; ++x)
      for (int z = 0; z < 5; ++z) town.add({2 * x, 0, 2 * z}, {2 * x + 1, 1 + x % 3, 2 * z + 1}, reversed);
    EXPECT_EQ(town.surroundings(), Surroundings::outside) << reversed;
  }
  EXPECT_EQ(Boxes().add(vec3(-1), vec3(1), kAllSides).add(vec3(-0.9f), vec3(0.9f)).surroundings(),
            Surroundings::outside)
      << "a mirrored hollow body";
}

TEST(DefaultView, StaysOutsideOfOpenPartsThatAreInsideOut) {
  std::string parts;  // a body of balls that reach into each other, each with a hole
  int vertices = 0;
  for (const vec3 middle : {vec3(0), vec3(0, 1.4f, 0), vec3(1.2f, 0, 0), vec3(-1.2f, 0, 0)}) {
    constexpr int kRings = 10, kSegments = 16;
    std::ostringstream out;
    for (int ring = 0; ring <= kRings; ++ring)
      for (int segment = 0; segment < kSegments; ++segment) {
        const double polar = 0.1 + (kPi - 0.1) * ring / kRings, azimuth = 2 * kPi * segment / kSegments;
        out << "v " << middle.x + std::sin(polar) * std::cos(azimuth) << ' ' << middle.y + std::cos(polar) << ' '
            << middle.z + std::sin(polar) * std::sin(azimuth) << '\n';
      }
    for (int ring = 0; ring < kRings; ++ring)
      for (int segment = 0; segment < kSegments; ++segment) {
        const int a = vertices + 1 + ring * kSegments + segment,
                  b = vertices + 1 + ring * kSegments + (segment + 1) % kSegments;
        out << "f " << a << ' ' << a + kSegments << ' ' << b + kSegments << ' ' << b << '\n';
      }
    vertices += (kRings + 1) * kSegments;
    parts += out.str();
  }
  EXPECT_EQ(view_of_obj(parts).surroundings, Surroundings::outside);
}

TEST(DefaultView, StandsUnderASkyDomeWhateverIsInIt) {
  for (const int reversed : {0, kAllSides})
    EXPECT_EQ(Boxes().add({-1, -8, -1}, {1, -7, 1}, reversed).add(vec3(-10), vec3(10), kAllSides).surroundings(),
              Surroundings::inside);
}

TEST(DefaultView, ARoomThatIsASmallPartOfTheSceneIsAThing) {
  Boxes room;
  room.add(vec3(-1), vec3(1), kAllSides).add({0, -1, 0}, {0.3f, -0.8f, 0.3f});
  EXPECT_EQ(room.surroundings(), Surroundings::inside);
  EXPECT_EQ(room.add({9, -1, 9}, {9.5f, 3, 9.5f}).surroundings(), Surroundings::outside);
}

TEST(DefaultView, SharedScenesAreWhatTheyAre) {
  const std::pair<const char*, Surroundings> scenes[] = {
      {"sibenik/sibenik.obj", Surroundings::inside},
      {"holodeck/holodeck.obj", Surroundings::inside},
      {"cornell_box/CornellBox-Mirror.obj", Surroundings::open},
      {"teapot/teapot.obj", Surroundings::outside},
      {"sports_car/sportsCar.obj", Surroundings::outside},
      {"armadillo/armadillo.obj", Surroundings::outside},
      {"scrub_pine/scrubPine.obj", Surroundings::outside}};  // its foliage shows back faces as often as front faces
  for (const auto& [name, surroundings] : scenes) {
    const std::filesystem::path path = std::filesystem::path(HYBRIDRT_SHARED_SCENES) / name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the shared scenes are not here";
    EXPECT_EQ(view_of(path.string()).surroundings, surroundings) << name;
  }
}

TEST(DefaultView, TheWholeOpeningIsInThePicture) {
  for (const vec3& size : {vec3(1), vec3(3, 1, 1), vec3(1, 3, 1), vec3(1, 1, 4)}) {
    std::string corners;
    for (int i : {0, 1, 3, 2, 4, 5, 7, 6})
      corners +=
          fmt::format("v {} {} {}\n", i & 1 ? size.x : -size.x, i & 2 ? size.y : -size.y, i & 4 ? size.z : -size.z);
    const DefaultView view = view_of_obj(corners + kFiveWallsInward);
    ASSERT_EQ(view.surroundings, Surroundings::open);
    for (double fraction : {0.0, 0.3, 1.0}) {
      const View seen = make_view(camera_on_orbit(view.orbit, fraction), dvec3(0), 400, 300);
      for (int corner = 0; corner < 4; ++corner) {
        const dvec3 p = dvec3(corner & 1 ? size.x : -size.x, corner & 2 ? size.y : -size.y, size.z) - seen.eye;
        EXPECT_LT(std::abs(glm::dot(p, seen.right)), seen.tan_half_width * glm::dot(p, seen.forward));
        EXPECT_LT(std::abs(glm::dot(p, seen.up)), seen.tan_half_height * glm::dot(p, seen.forward));
      }
    }
  }
}

// A floor that rises to a wall behind a ball, both seen from their front only.
TEST(DefaultView, ABackdropIsSeenFromItsFront) {
  for (int side = 0; side < 4; ++side) {
    const double angle = side * kPi / 2, c = std::cos(angle), s = std::sin(angle);
    std::string text;
    for (const dvec3& p : {dvec3(-4, 0, 4), dvec3(4, 0, 4), dvec3(4, 0, -4), dvec3(-4, 0, -4), dvec3(4, 6, -4),
                           dvec3(-4, 6, -4), dvec3(0, 0.1, 0), dvec3(0.2, 0.1, 0), dvec3(0, 0.4, 0)})
      text += fmt::format("v {} {} {}\n", c * p.x + s * p.z, p.y, c * p.z - s * p.x);
    const DefaultView view = view_of_obj(text + "f 1 2 3 4\nf 4 3 5 6\nf 7 8 9\n");
    EXPECT_EQ(view.surroundings, Surroundings::outside);
    const dvec3 eye = camera_on_orbit(view.orbit, 0).eye_world;
    EXPECT_GT(eye.x * s + eye.z * c, 0) << "side " << side;
    EXPECT_NEAR(view.orbit.to_rad - view.orbit.from_rad, 2 * kPi, 1e-9) << "a whole turn";
  }
}

TEST(DefaultView, KnowsWhetherACameraStandsInAClosedRoom) {
  ThreadPool pool(1);
  Warnings warnings;
  const TemporaryFolder folder;
  const auto inside = [&](const std::string& faces, const dvec3& eye) {
    const Scene scene = load_scene(folder.write("room.obj", kCorners + faces).string(), pool, warnings);
    return is_in_closed_room({scene, build_topology(scene, pool), scene.bounds, *make_embree_caster(scene, 1)},
                             vec3(eye));
  };
  const std::string walls = kFiveWallsInward, closed = walls + kFrontWallInward;
  EXPECT_TRUE(inside(closed, {0.5, 0, 0.3}));
  EXPECT_FALSE(inside(closed, {0, 0, 3}));
  EXPECT_FALSE(inside(walls, {0, 0, 0})) << "open at the front";
  EXPECT_FALSE(inside("f 4 3 2 1\nf 5 8 4 1\nf 3 7 6 2\nf 2 6 5 1\nf 8 7 3 4\nf 6 7 8 5\n", {0, 0, 0})) << "in a solid";
}

// Whichever way a surface faces, outside or in an open room, its brightness changes with its direction.
TEST(DefaultAmbient, ShowsFormWhereTheLightDoesNotReach) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const dvec3 toward = glm::normalize(dvec3(random.direction()));
    const AmbientLight ambient = default_ambient(Surroundings::outside, toward);
    EXPECT_GT(glm::length(ambient.slope), 0.5f);
    EXPECT_LT(glm::length(ambient.slope), 1) << "no surface is black";
    EXPECT_GT(ambient.slope.y, 0) << "more from the sky";
    const dvec3 level(toward.x, 0, toward.z);
    EXPECT_LE(glm::dot(dvec3(ambient.slope), level), 0) << "more from the light's other side";
    const DirectionalLight light = default_light(Surroundings::outside, {dvec3(random.direction()), dvec3(0)}, ambient);
    const vec3 white = light.color + ambient.color * (1 + glm::dot(ambient.slope, vec3(light.toward)));
    EXPECT_NEAR(white.x, 1, 1e-6) << "a white surface that faces the light is just white";
  }
  EXPECT_EQ(default_ambient(Surroundings::inside, {0, 1, 0}).slope, vec3(0));
}

TEST(DefaultLight, ComesFromAboveLeftAndBehindTheCamera) {
  const Scene scene = boxed(vec3(-1), vec3(1));
  for (int step = 0; step < 36; ++step) {
    const Camera camera = camera_on_orbit(default_orbit(scene, scene.bounds, 1.5, kPi / 4), step / 36.0);
    const View view = make_view(camera, dvec3(0), 150, 100);
    const dvec3 toward = default_light(Surroundings::outside, camera, vec3(0.15f)).toward;
    EXPECT_NEAR(glm::length(toward), 1, 1e-12);
    EXPECT_GT(toward.y, 0.3) << "above";
    EXPECT_LT(glm::dot(toward, view.right), -0.2) << "left";
    EXPECT_LT(glm::dot(toward, view.forward), -0.2) << "behind";
  }
}

TEST(DefaultLight, CameraLookingStraightDown) {
  const dvec3 toward = default_light(Surroundings::outside, {{0, 5, 0}, {0, 0, 0}, {0, 0, -1}, 1}, vec3(0)).toward;
  EXPECT_NEAR(glm::length(toward), 1, 1e-12);
  EXPECT_GT(toward.y, 0);
}

}  // namespace
}  // namespace hybridrt
