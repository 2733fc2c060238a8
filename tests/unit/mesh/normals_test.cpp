#include "core/mesh/normals.h"

#include <set>

#include "core/procedural/spheres.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

vec3 normal_of(const Scene& scene, uint32_t t, int k) { return scene.normals[scene.triangle_normals[t][k]]; }

dvec3 face_normal(const Scene& scene, uint32_t t) {
  const dvec3 a(scene.vertex(t, 0));
  return glm::normalize(glm::cross(dvec3(scene.vertex(t, 1)) - a, dvec3(scene.vertex(t, 2)) - a));
}

void drop_normals(Scene& scene) {
  scene.normals.clear();
  scene.triangle_normals.assign(scene.triangle_count(), uvec3(kNoNormal));
}

const std::string kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(Normals, ACubeStaysSharpAndSharesThem) {
  const Scene scene = load_text(kCube).scene;
  ASSERT_EQ(scene.triangle_count(), 12u);
  for (uint32_t t = 0; t < 12; ++t)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(dvec3(normal_of(scene, t, k)), face_normal(scene, t));
  EXPECT_EQ(scene.normals.size(), 24u) << "three at each of eight corners";
}

TEST(Normals, AFineSphereIsSmooth) {
  Scene scene = make_spheres({.triangles = 20'000, .reflective_percent = 0});
  const Scene exact = scene;
  drop_normals(scene);
  ThreadPool pool(2);
  rebuild_missing_normals(scene, pool);
  validate(scene);
  double worst = 1;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      worst = std::min<double>(worst, glm::dot(normal_of(scene, t, k), normal_of(exact, t, k)));
  EXPECT_GT(worst, std::cos(1.0 * kPi / 180)) << "within a degree of the analytic normal";
  EXPECT_EQ(scene.normals.size(), scene.positions.size()) << "one per vertex: smooth all around";
}

TEST(Normals, VerticesOfTheirOwnAreWelded) {
  Scene indexed = make_spheres({.triangles = 2000, .reflective_percent = 0});
  drop_normals(indexed);
  Scene soup = indexed;
  soup.positions.clear();
  for (uvec3& triangle : soup.triangle_positions)
    for (int k = 0; k < 3; ++k) {
      soup.positions.push_back(indexed.positions[triangle[k]]);
      triangle[k] = static_cast<uint32_t>(soup.positions.size() - 1);
    }
  ThreadPool pool(2);
  rebuild_missing_normals(indexed, pool);
  rebuild_missing_normals(soup, pool);
  for (uint32_t t = 0; t < indexed.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) ASSERT_EQ(normal_of(indexed, t, k), normal_of(soup, t, k));
}

TEST(Normals, TheWeightIsTheAngle) {
  // Over a ridge of 2 x 20 degrees. One side is cut into two triangles, and must not count twice.
  const double c = std::cos(20 * kPi / 180), s = std::sin(20 * kPi / 180);
  const Scene scene =
      load_text(fmt::format("v 0 0 0\nv 0 0 2\nv {0} -{1} 1\nv {0} -{1} 0\nv -{0} -{1} 1\nv -{0} -{1} 0\n"
                            "f 1 2 3\nf 1 3 4\nf 1 6 5\nf 1 5 2\n",
                            c, s))
          .scene;
  EXPECT_NEAR(glm::distance(normal_of(scene, 0, 0), vec3(0, 1, 0)), 0, 1e-6);
}

TEST(Normals, TheFilesOwnAreKept) {
  const Loaded loaded = load_text(kTriangle + "vn 0 0 -1\nvn 3 0 4\nf 1//1 2//2 3\n");
  EXPECT_EQ(normal_of(loaded.scene, 0, 0), vec3(0, 0, -1)) << "even against the face";
  EXPECT_NEAR(glm::distance(normal_of(loaded.scene, 0, 1), vec3(0.6f, 0, 0.8f)), 0, 1e-6);
  EXPECT_EQ(normal_of(loaded.scene, 0, 2), vec3(0, 0, 1));
}

/// A cone of `faces` faces around its tip, vertex 0.
Scene cone(int faces) {
  std::string text = "v 0 0 1\n";
  for (int i = 0; i < faces; ++i)
    text += fmt::format("v {} {} 0\n", 4 * std::cos(2 * kPi * i / faces), 4 * std::sin(2 * kPi * i / faces));
  for (int i = 0; i < faces; ++i) text += fmt::format("f 1 {} {}\n", i + 2, (i + 1) % faces + 2);
  return load_text(text).scene;
}

TEST(Normals, FansAreSmoothUpToALimit) {
  EXPECT_NEAR(glm::distance(normal_of(cone(200), 0, 0), vec3(0, 0, 1)), 0, 1e-5);
  for (const int faces : {300, 200'000}) {  // the second would take minutes if it were quadratic
    const Scene scene = cone(faces);
    EXPECT_EQ(normal_of(scene, 7, 0), vec3(face_normal(scene, 7)));
  }
}

TEST(Normals, DoNotDependOnThreads) {
  Scene one = make_spheres({.triangles = 100'000, .reflective_percent = 0});
  drop_normals(one);
  Scene four = one;
  ThreadPool pool1(1), pool4(4);
  rebuild_missing_normals(one, pool1);
  rebuild_missing_normals(four, pool4);
  EXPECT_EQ(one.normals, four.normals);
  EXPECT_EQ(one.triangle_normals, four.triangle_normals);
}

}  // namespace
}  // namespace hybridrt
