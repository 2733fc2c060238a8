#include "core/scene/view.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

void expect_orthonormal(const View& view) {
  for (const dvec3& axis : {view.right, view.up, view.forward}) EXPECT_NEAR(glm::length(axis), 1, 1e-12);
  EXPECT_NEAR(glm::dot(view.right, view.up), 0, 1e-12);
  EXPECT_NEAR(glm::dot(view.right, view.forward), 0, 1e-12);
  EXPECT_NEAR(glm::dot(view.up, view.forward), 0, 1e-12);
  EXPECT_GT(glm::dot(glm::cross(view.right, view.up), -view.forward), 0.999) << "mirrored";
}

Camera random_camera(Random& random) {
  Camera camera;
  camera.eye_world = dvec3(random.in_cube(-10, 10));
  camera.target_world = camera.eye_world + dvec3(random.between(0.01f, 20) * random.direction());
  camera.up = dvec3(random.direction());
  camera.fov_y_rad = random.between(0.05f, 3);
  return camera;
}

TEST(View, IsAnOrthonormalFrameThatLooksAtTheTarget) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Camera camera = random_camera(random);
    const View view = make_view(camera, dvec3(0), 160, 90);
    expect_orthonormal(view);
    EXPECT_NEAR(glm::dot(view.forward, glm::normalize(camera.target_world - camera.eye_world)), 1, 1e-12);
    EXPECT_GE(glm::dot(view.up, camera.up), 0) << "upside down";
    EXPECT_NEAR(view.tan_half_height, std::tan(camera.fov_y_rad / 2), 1e-12);
    EXPECT_NEAR(view.tan_half_width / view.tan_half_height, 16.0 / 9, 1e-12);
  }
}

TEST(View, PixelsGoFromTopLeftToBottomRight) {
  const View view = make_view({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, kPi / 2}, dvec3(0), 4, 2);
  EXPECT_NEAR(glm::distance(view.pixel_dir(0, 0), dvec3(-1.5, 0.5, -1)), 0, 1e-12);
  EXPECT_NEAR(glm::distance(view.pixel_dir(3, 1), dvec3(1.5, -0.5, -1)), 0, 1e-12);
}

// Points on a pixel's ray project to the pixel's centre, nearer ones with a larger depth.
TEST(View, ProjectionAndRaysAgree) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const int width = 1 + static_cast<int>(random.below(2000)), height = 1 + static_cast<int>(random.below(2000));
    const double near = random.between(1e-6f, 1e-2f);
    const View view = make_view(random_camera(random), dvec3(0), width, height);
    const dmat4 projection = clip_from_eye(view, near);
    const int x = static_cast<int>(random.below(width)), y = static_cast<int>(random.below(height));
    double previous_depth = 1;
    for (double t = near * 1.01; t < 1e7; t *= 3) {
      const dvec4 clip = projection * dvec4(t * view.pixel_dir(x, y), 1);
      EXPECT_NEAR(clip.w, t, 1e-9 * t) << "w is the distance along the view";
      const dvec3 ndc = dvec3(clip) / clip.w;
      // Upper-left origin: y grows upward in clip space and row 0 is on top.
      EXPECT_NEAR((ndc.x + 1) / 2 * width, x + 0.5, 1e-6);
      EXPECT_NEAR((1 - ndc.y) / 2 * height, y + 0.5, 1e-6);
      EXPECT_NEAR(ndc.z, near / t, 1e-9);
      EXPECT_LT(ndc.z, previous_depth) << "depth is not monotone";
      EXPECT_GT(ndc.z, 0) << "nothing is too far away";
      previous_depth = ndc.z;
    }
  }
}

TEST(View, UpAlongTheViewIsReplaced) {
  for (const dvec3& forward : {dvec3(0, 1, 0), dvec3(0, -1, 0), dvec3(1, 0, 0), dvec3(0.6, 0, 0.8), dvec3(0, 0, -1)})
    for (double sign : {1.0, -1.0})
      expect_orthonormal(make_view({dvec3(0), 7.0 * forward, sign * forward, 1}, dvec3(0), 10, 10));
}

TEST(View, ZeroUpIsReplaced) { expect_orthonormal(make_view({{0, 0, 1}, {0, 0, 0}, {0, 0, 0}, 1}, dvec3(0), 9, 9)); }

TEST(View, EyeAtTheTargetIsRefused) {
  try {
    make_view({{1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 1}, dvec3(0), 10, 10);
    FAIL() << "it was accepted";
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::input);
    EXPECT_NE(std::string(refused.what()).find("target"), std::string::npos);
  }
}

// The eye is subtracted in double: a scene far away is as precise as one at the origin.
TEST(View, SceneOriginIsTakenOff) {
  const dvec3 origin(1e7, -2e6, 3e5);
  const View far = make_view({origin + dvec3(1, 2, 3), origin, {0, 1, 0}, 1}, origin, 64, 48);
  const View near = make_view({{1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 1}, dvec3(0), 64, 48);
  EXPECT_NEAR(glm::distance(far.eye, near.eye), 0, 1e-8);
  EXPECT_NEAR(glm::distance(far.pixel_dir(5, 7), near.pixel_dir(5, 7)), 0, 1e-8);
}

// The picture's solid angle, summed over its pixels, is that of a rectangle seen from its middle's axis.
TEST(View, PixelsShareTheSolidAngleOfThePicture) {
  View view;
  view.width_px = view.frame_width_px = 160, view.height_px = view.frame_height_px = 120;
  view.tan_half_width = 1.2, view.tan_half_height = 0.9;
  double sum = 0;
  for (int y = 0; y < view.height_px; ++y)
    for (int x = 0; x < view.width_px; ++x) sum += view.sample_solid_angle(x, y);
  const double a = view.tan_half_width, b = view.tan_half_height;
  EXPECT_NEAR(sum, 4 * std::atan(a * b / std::sqrt(1 + a * a + b * b)), 1e-4);
  EXPECT_GT(view.sample_solid_angle(80, 60), 3 * view.sample_solid_angle(0, 0)) << "smaller toward the corners";
}

}  // namespace
}  // namespace hybridrt
