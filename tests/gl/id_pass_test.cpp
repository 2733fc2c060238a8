// Pass 2's ids against primary rays cast in double.

#include "core/load/obj_writer.h"
#include "core/procedural/spheres.h"
#include "tests/gl/pass_test.h"
#include "tests/support/load_obj.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {

// Rasterisation snaps vertices to 1/256 of a pixel, so at a triangle's outline its neighbour may be seen: pixels may
// differ only there, and at most one in a thousand.
constexpr double kSnap_px = 1.0 / 64, kMostDiffering = 1e-3;

dvec2 nearest_on_segment(const dvec2& a, const dvec2& b, const dvec2& p) {
  const dvec2 edge = b - a;
  const double length2 = glm::dot(edge, edge);
  return a + (length2 > 0 ? std::clamp(glm::dot(p - a, edge) / length2, 0.0, 1.0) : 0) * edge;
}

/// Whether pixel (x, y) may see `id` although its centre does not: no triangle lies there, or `id` is drawn
/// within kSnap_px of the centre and no farther away than what the centre sees.
bool explained_by_snapping(const Scene& scene, const View& view, const PrimaryRays& rays, uint32_t id, int x, int y) {
  for (int i = 0; i < 16; ++i)
    if (rays.triangle_at(view, x, y, kSnap_px * std::cos(i * kPi / 8), kSnap_px * std::sin(i * kPi / 8)) == id)
      return true;
  if (id == kNoTriangle) return false;
  dvec2 corners[3];  // pixels
  double distance = 0;
  for (int corner = 0; corner < 3; ++corner) {
    const dvec3 p = dvec3(scene.vertex(id, corner)) - view.eye;
    const double depth = glm::dot(p, view.forward);
    if (depth <= 0) return false;
    distance += depth / 3;
    corners[corner] = {(glm::dot(p, view.right) / depth / view.tan_half_width + 1) * 0.5 * view.width_px,
                       (1 - glm::dot(p, view.up) / depth / view.tan_half_height) * 0.5 * view.height_px};
  }
  const dvec2 centre(x + 0.5, y + 0.5);
  double nearest = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 3; ++corner)
    nearest = std::min(nearest,
                       glm::distance(centre, nearest_on_segment(corners[corner], corners[(corner + 1) % 3], centre)));
  return nearest <= kSnap_px && distance <= 1.01 * rays.closest({view.eye, view.pixel_dir(x, y)}).t;
}

class IdPass : public GlTest {
 protected:
  void expect_ids_of_rays(const Scene& scene, const Camera& camera, int width = 400, int height = 300) {
    const View view = make_view(camera, scene.origin_world, width, height);
    const FramePlan plan = make_frame_plan(scene, make_scene_facts(scene), {1, camera, {}}, settings(width, height));
    const std::vector<uint32_t> ids = SeenScene(context(), scene, view, plan.near_distance).read_ids();
    const PrimaryRays rays(scene);
    int hit = 0, differ = 0, unexplained = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const uint32_t id = ids[static_cast<size_t>(y) * width + x], truth = rays.triangle_at(view, x, y);
        hit += truth != kNoTriangle;
        if (id == truth) continue;
        ++differ;
        unexplained += !explained_by_snapping(scene, view, rays, id, x, y);
      }
    EXPECT_GT(hit, width * height / 10) << "hardly anything is in view";
    EXPECT_LE(differ, kMostDiffering * width * height) << hit << " pixels see a triangle";
    EXPECT_EQ(unexplained, 0) << "of " << differ << " that differ";
    RecordProperty("differ", differ);
  }

  static RenderSettings settings(int width, int height) {
    RenderSettings s;
    s.width_px = width;
    s.height_px = height;
    return s;
  }
};

TEST_F(IdPass, Spheres) {
  const Scene scene = make_spheres({3000, 0});
  for (double angle : {0.0, 1.3, 4.0}) expect_ids_of_rays(scene, camera_at_angle(scene, angle, 0.6));
}

TEST_F(IdPass, RandomSoup) {
  const Scene scene = with_normals(random_soup(7, 300, 0.4f));
  for (double angle : {0.5, 2.0}) expect_ids_of_rays(scene, camera_at_angle(scene, angle, 0.9));
}

TEST_F(IdPass, SceneSeenFromItsMiddle) {
  const Scene scene = with_normals(closed_box());
  const Camera inside{{0.4, 0.5, 0.6}, {1, 0.2, 0.1}, {0, 1, 0}, 1.5};
  expect_ids_of_rays(scene, inside);
}

TEST_F(IdPass, OddSizes) {
  const Scene scene = with_normals(closed_sphere(16, 8));
  expect_ids_of_rays(scene, camera_at_angle(scene, 1, 0.7), 137, 91);
  expect_ids_of_rays(scene, camera_at_angle(scene, 1, 0.7), 3, 211);
}

TEST_F(IdPass, TinyAndHugeScenes) {
  for (float scale : {1e-6f, 1e6f}) {
    const Scene scene = with_normals(transformed(closed_sphere(24, 12), scale, vec3(0)));
    expect_ids_of_rays(scene, camera_at_angle(scene, 2, 0.8), 200, 150);
  }
}

// Loading subtracts the offset, so a scene at geographic coordinates is as good as one at the origin.
TEST_F(IdPass, SceneFarFromTheOrigin) {
  const TemporaryFolder folder;
  ThreadPool pool(1);
  Scene scene = make_spheres({1000, 0});
  scene.origin_world = dvec3(1e6, -5e5, 1e7);
  write_obj(scene, folder.path / "far.obj");
  Warnings warnings;
  const Scene far = load_obj(folder.path / "far.obj", pool, warnings);
  EXPECT_GT(glm::length(far.origin_world), 1e6);
  expect_ids_of_rays(far, camera_at_angle(far, 0.7, 0.6));
}

TEST_F(IdPass, NothingInViewIsNoTriangle) {
  const Scene scene = make_spheres({200, 0});
  Camera away = camera_at_angle(scene, 0, 1);
  away.target_world = away.eye_world + (away.eye_world - away.target_world);
  const View view = make_view(away, dvec3(0), 33, 17);
  for (uint32_t id : SeenScene(context(), scene, view, 1e-5).read_ids()) ASSERT_EQ(id, kNoTriangle);
}

}  // namespace
}  // namespace hybridrt
