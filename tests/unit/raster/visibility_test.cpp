#include "core/raster/visibility.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "core/trace/triangle.h"
#include "tests/support/raster_views.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

/// A scene with what answers for it.
struct Oracle {
  Scene scene;
  ThreadPool pool{2};
  KdTree tree = build_kd_tree(scene, pool);
  std::unique_ptr<RayCaster<double>> caster = make_reference_caster(tree);
  Clusters clusters = make_clusters(scene, pool);

  explicit Oracle(Scene scene_) : scene(std::move(scene_)) {}

  /// Pixels of the view at which the rasteriser is wrong.
  int wrong_pixels(const View& view) {
    const std::vector<uint32_t> truth = reference_ids(*caster, view, pool);
    const std::vector<uint32_t> ids = rasterized_ids(scene, clusters, view, pool);
    int wrong = 0;
    for (size_t i = 0; i < ids.size(); ++i) wrong += ids[i] != truth[i];
    return wrong;
  }

  /// The same of several samples of some pixels (sample_some_pixels).
  int wrong_samples_of(const View& view, Random& random) {
    return wrong_samples(*caster, sample_some_pixels(scene, clusters, view, pool, random), pool);
  }
};

std::string described(const View& v) {
  return fmt::format("{}x{}+{}+{} of {}x{}, tangents {} {}, eye {} {} {}, forward {} {} {}, sample {} {}", v.width_px,
                     v.height_px, v.x_px, v.y_px, v.frame_width_px, v.frame_height_px, v.tan_half_width,
                     v.tan_half_height, v.eye.x, v.eye.y, v.eye.z, v.forward.x, v.forward.y, v.forward.z, v.sample_px.x,
                     v.sample_px.y);
}

std::vector<NamedScene> raster_scenes() {
  std::vector<NamedScene> scenes = all_test_scenes();
  scenes.push_back({"DoubledFaces", doubled_faces(11)});
  scenes.push_back({"SheetOnCenters", sheet_on_centers(24)});
  scenes.push_back({"HugeAndSmall", huge_and_small(12)});
  scenes.push_back({"Holes", with_random_holes(random_soup(13, 400, 0.4f), 3)});
  scenes.push_back({"AllKindsOfHoles", with_all_kinds_of_holes(random_soup(15, 400, 0.4f), 5)});
  scenes.push_back({"AllKindsOfHolesInSlivers", with_all_kinds_of_holes(slivers(16, 300), 6)});
  scenes.push_back({"HolesInDuplicates", with_random_holes(with_duplicates(14), 4)});
  return scenes;
}

class Visibility : public testing::TestWithParam<NamedScene> {};

TEST_P(Visibility, EqualsTheRayTestAtEveryPixelOfRandomViews) {
  Oracle oracle(GetParam().scene);
  Random random(2005);
  for (int i = 0; i < 40; ++i) {
    const View view = random_view(oracle.scene, random);
    ASSERT_EQ(oracle.wrong_pixels(view), 0) << "view " << i << ": " << described(view);
  }
}

TEST_P(Visibility, SamplesEqualTheRayTestInRandomViews) {
  Oracle oracle(GetParam().scene);
  Random random(2026);
  for (int i = 0; i < 20; ++i)
    ASSERT_EQ(oracle.wrong_samples_of(random_view(oracle.scene, random), random), 0) << "view " << i;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Visibility, testing::ValuesIn(raster_scenes()), test_name);

/// Calls body(oracle) for some scenes under each instruction set.
template <typename Body>
void under_every_instruction_set(const Body& body) {
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (Scene scene :
         {random_soup(21, 3000, 0.1f), slivers(22, 300), doubled_faces(23),
          with_random_holes(random_soup(24, 200, 0.5f), 5), with_all_kinds_of_holes(random_soup(25, 2000, 0.1f), 6)}) {
      Oracle oracle(std::move(scene));
      body(oracle);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(Visibility, IsExactUnderEveryInstructionSet) {
  under_every_instruction_set([](Oracle& oracle) {
    Random random(7);
    for (int i = 0; i < 12; ++i) ASSERT_EQ(oracle.wrong_pixels(random_view(oracle.scene, random)), 0) << "view " << i;
  });
}

TEST(Visibility, SamplesAreExactUnderEveryInstructionSet) {
  under_every_instruction_set([](Oracle& oracle) {
    Random random(8);
    for (int i = 0; i < 8; ++i)
      ASSERT_EQ(oracle.wrong_samples_of(random_view(oracle.scene, random), random), 0) << "view " << i;
  });
}

TEST(Visibility, DecidesCentersOnVerticesAndEdges) {
  Oracle oracle(sheet_on_centers(24));
  for (const double height : {3.0, 24.0, 1000.0}) EXPECT_EQ(oracle.wrong_pixels(sheet_view(24, height)), 0) << height;
}

TEST(Visibility, DecidesCentersBesideEdgesByLessThanRounding) {
  Oracle oracle(sheet_on_centers(64));
  Random random(17);
  for (int i = 0; i < 60; ++i) ASSERT_EQ(oracle.wrong_pixels(sheet_view_beside(64, random)), 0) << i;
}

TEST(Visibility, DecidesThemForTrianglesThatAreTooLargeForFloatsToo) {
  constexpr float kHuge = 0x1p54f;
  Oracle oracle(transformed(sheet_on_centers(64), kHuge, vec3(0)));
  Random random(17);
  for (int i = 0; i < 30; ++i) {
    View view = sheet_view_beside(64, random);
    view.eye *= kHuge;
    ASSERT_EQ(oracle.wrong_pixels(view), 0) << i;
  }
}

TEST(Visibility, DecidesDepthsThatFloatsHardlyTellApart) {
  Oracle oracle(nearly_one_plane(18));
  Random random(19);
  for (int i = 0; i < 40; ++i) {
    const View view = view_of_plane(random);
    ASSERT_EQ(oracle.wrong_pixels(view), 0) << i << ": " << described(view);
  }
}

TEST(Visibility, SamplesAreDecidedBesideEdgesByLessThanRounding) {
  for (const float enlarged : {1.0f, 0x1p54f}) {  // so large that floats do not hold the triangles
    Oracle oracle(transformed(sheet_on_centers(64), enlarged, vec3(0)));
    Random random(17);
    for (int i = 0; i < 20; ++i) {
      View view = sheet_view_beside(64, random);
      view.eye *= enlarged;
      ASSERT_EQ(oracle.wrong_samples_of(view, random), 0) << i;
    }
  }
}

TEST(Visibility, SamplesAreDecidedWhereFloatsHardlyTellDepthsApart) {
  Oracle oracle(nearly_one_plane(18));
  Random random(19);
  for (int i = 0; i < 15; ++i) ASSERT_EQ(oracle.wrong_samples_of(view_of_plane(random), random), 0) << i;
}

/// Squares of 4, 12 and 96 pixels are sampled in different ways.
TEST(Visibility, DecidesCentersBesideBordersOfTexelsByLessThanRounding) {
  for (const int step : {1, 3, 24})
    for (const bool clamped : {false, true}) {
      Oracle oracle(sheet_of_holes(48, step, clamped ? 0.125f : 2.0f, clamped));
      Random random(17);
      for (int i = 0; i < 20; ++i) {
        const View view = sheet_view_beside(48, random);
        ASSERT_EQ(oracle.wrong_pixels(view), 0) << step << ", " << i;
        if (i % 5 == 0) {
          ASSERT_EQ(oracle.wrong_samples_of(view, random), 0) << step << ", " << i;
        }
      }
    }
}

TEST(Visibility, DecidesTexelsThatAreSmallerThanVerticesAreOff) {
  // Clusters of triangles that are small and far apart, each enlarged to some pixels.
  constexpr float kSize = 0.0005f;
  constexpr double kPixel = kSize / 8, kDistance = 4;
  Oracle oracle(with_all_kinds_of_holes(random_soup(26, 600, kSize), 7));
  Random random(27);
  for (int i = 0; i < 100; ++i) {
    const uint32_t t = random.below(600);
    Camera camera;
    camera.target_world = dvec3(oracle.scene.vertex(t, 0));
    camera.eye_world = camera.target_world + kDistance * dvec3(random.direction());
    camera.fov_y_rad = 2 * std::atan(24 * kPixel / kDistance);
    ASSERT_EQ(oracle.wrong_pixels(make_view(camera, dvec3(0), 64, 48)), 0) << i;
  }
}

TEST(Visibility, OfExactDuplicatesTheOneThatFacesTheEyeIsSeen) {
  Scene scene;
  add_triangle(scene, vec3(0, 0, 0), vec3(0, 1, 0), vec3(1, 0, 0));  // clockwise as seen from +z
  add_triangle(scene, vec3(0, 1, 0), vec3(0, 0, 0), vec3(1, 0, -0.0f));
  add_triangle(scene, vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 0));
  scene.bounds = compute_bounds(scene);
  Oracle oracle(std::move(scene));
  for (const double side : {1.0, -1.0}) {
    Camera camera;
    camera.eye_world = dvec3(0.25, 0.3, side);
    camera.target_world = dvec3(0.25, 0.3, 0);
    const View view = make_view(camera, dvec3(0), 9, 9);
    EXPECT_EQ(oracle.wrong_pixels(view), 0);
    EXPECT_EQ(rasterized_ids(oracle.scene, oracle.clusters, view, oracle.pool)[40], side > 0 ? 1u : 0u);
  }
}

TEST(Visibility, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = with_random_holes(random_soup(31, 20000, 0.05f), 6);
  ThreadPool one(1), four(4);
  const Clusters clusters = make_clusters(scene, one), again = make_clusters(scene, four);
  EXPECT_EQ(clusters.words, again.words);
  EXPECT_EQ(clusters.radius, again.radius);
  Random random(9);
  for (int i = 0; i < 10; ++i) {
    const View view = random_view(scene, random);
    ASSERT_EQ(rasterized_ids(scene, clusters, view, one), rasterized_ids(scene, clusters, view, four)) << i;
  }
}

TEST(Clusters, HoldEveryTriangleOnceAndAreSmall) {
  const Scene scene = with_degenerates(5);
  ThreadPool pool(2);
  const Clusters clusters = make_clusters(scene, pool);
  std::vector<int> times(scene.triangle_count());
  for (const Cluster& cluster : clusters.clusters) {
    ASSERT_LE(cluster.vertex_count, kClusterVertices);
    ASSERT_LE(cluster.triangle_count, kClusterTriangles);
    const int stride = Clusters::padded(cluster.vertex_count);
    for (int n = 0; n < cluster.triangle_count; ++n) {
      const uint32_t triangle = clusters.triangles(cluster)[n], corners = clusters.corners(cluster)[n];
      ++times[triangle];
      EXPECT_EQ(corners >> 24, static_cast<uint32_t>(n));
      for (int k = 0; k < 3; ++k) {
        const float* offset = clusters.offsets(cluster) + (corners >> 8 * k & 255);
        const dvec3 there = dvec3(cluster.center) + dvec3(offset[0], offset[stride], offset[2 * stride]);
        EXPECT_LE(glm::length(there - dvec3(scene.vertex(triangle, k))), 1e-7 * cluster.radius);
        EXPECT_LE(glm::length(there - dvec3(cluster.center)), cluster.radius);
      }
    }
  }
  for (uint32_t i = 0; i < scene.triangle_count(); ++i)
    EXPECT_EQ(times[i], is_degenerate(scene.vertex(i, 0), scene.vertex(i, 1), scene.vertex(i, 2)) ? 0 : 1);
}

}  // namespace
}  // namespace hybridrt
