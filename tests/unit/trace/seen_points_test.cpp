#include "core/trace/seen_points.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "core/trace/primary_surface.h"
#include "tests/support/raster_views.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

const std::vector<TracedLight> kLights = {
    {{glm::normalize(dvec3(0.3, 1, 0.2))}}, {{glm::normalize(dvec3(-1, 0.1, -0.4))}}, {{dvec3(0, 0, 1)}}};

/// Points that pixels of the view see, at most as many as fit.
SeenPoints points_of(const View& view, const std::vector<uint32_t>& ids, size_t first) {
  SeenPoints points;
  for (size_t i = first; i < ids.size() && points.count < SeenPoints::kMost; ++i) {
    if (ids[i] == kNoTriangle) continue;
    points.x[points.count] = static_cast<int>(i % view.width_px);
    points.y[points.count] = static_cast<int>(i / view.width_px);
    points.triangle[points.count++] = ids[i];
  }
  return points;
}

void expect_as_one_by_one(const Scene& scene, const View& view, const SeenPoints& points) {
  for (int i = 0; i < points.count; ++i) {
    const dvec3 dir = glm::normalize(view.pixel_dir(points.x[i], points.y[i]));
    const dvec3 weights = seen_barycentrics(scene, points.triangle[i], view.eye, dir);
    ASSERT_EQ(points.u[i], static_cast<float>(weights.y));
    ASSERT_EQ(points.v[i], static_cast<float>(weights.z));
    unsigned facing = 0;
    for_each_facing_light(scene, points.triangle[i], view.eye, dir, kLights, [&](size_t l, const ShadowQuery& query) {
      facing |= 1u << l;
      for (int k = 0; k < 3; ++k) ASSERT_EQ(points.origin[k][i], query.origin[k]);
      ASSERT_EQ(points.from_front[i] != 0, query.from_front);
    });
    ASSERT_EQ(points.facing[i], facing);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(points.dir[k][i], static_cast<float>(dir[k]));
    if (!scene.textures) continue;
    ASSERT_EQ(points.solid_angle[i], static_cast<float>(view.sample_solid_angle(points.x[i], points.y[i])));
    const dvec3 origin(points.origin[0][i], points.origin[1][i], points.origin[2][i]);
    ASSERT_EQ(points.distance[i], static_cast<float>(glm::distance(view.eye, origin)));
  }
}

TEST(SeenPoints, AreThoseOfSinglePixelsToTheLastBitUnderEveryInstructionSet) {
  ThreadPool pool(2);
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    Random random(3);
    for (const Scene& scene : {random_soup(41, 800, 0.3f), slivers(42, 200), closed_box(), huge_and_small(43),
                               with_random_holes(random_soup(44, 400, 0.3f), 45)}) {
      const Clusters clusters = make_clusters(scene, pool);
      for (int i = 0; i < 6; ++i) {
        const View view = random_view(scene, random);
        const std::vector<uint32_t> ids = rasterized_ids(scene, clusters, view, pool);
        for (size_t first = 0; first < ids.size(); first += 1 + ids.size() / 3) {
          SeenPoints points = points_of(view, ids, first);
          find_points(scene, view, kLights, points);
          expect_as_one_by_one(scene, view, points);
        }
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace
}  // namespace hybridrt
