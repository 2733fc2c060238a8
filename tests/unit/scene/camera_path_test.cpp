#include "core/scene/camera_path.h"

#include <cctype>

#include "core/scene/view.h"
#include "tests/support/camera_text.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

const string kFour = key(1, "[0,0,10]") + "," + key(11, "[10,0,0]", ",\"fov_y_deg\":60") + "," +
                     key(31, "[10,5,-10]", ",\"fov_y_deg\":60") + "," + key(41, "[0,0,-10]", ",\"fov_y_deg\":20");

TEST(CameraPath, GoesThroughItsKeysAndHoldsBeyondThem) {
  const CameraPath path = read_path(kFour);
  for (const CameraKey& k : path.keys) EXPECT_EQ(camera_on_path(path, k.frame).eye_world, k.camera.eye_world);
  EXPECT_EQ(camera_on_path(path, -100).eye_world, dvec3(0, 0, 10));
  EXPECT_EQ(camera_on_path(path, 1e9).eye_world, dvec3(0, 0, -10));
}

TEST(CameraPath, IsSmoothBetweenKeys) {
  // The curve's direction does not jump at a key: centripetal pieces share their tangents.
  const CameraPath path = read_path(kFour);
  const auto eye = [&](double frame) { return camera_on_path(path, frame).eye_world; };
  for (double frame : {11.0, 31.0}) {
    const double h = 1e-5;
    const dvec3 before = glm::normalize(eye(frame) - eye(frame - h));
    const dvec3 after = glm::normalize(eye(frame + h) - eye(frame));
    EXPECT_GT(glm::dot(before, after), 1 - 1e-6) << frame;
  }
  EXPECT_GT(glm::distance(eye(6), 0.5 * (eye(1) + eye(11))), 0.1) << "a curve, not a chain of straight lines";
}

TEST(CameraPath, EvenlySpacedKeysOnALineAreAStraightEvenMove) {
  const CameraPath path = read_path(key(0, "[1,0,5]") + "," + key(10, "[2,0,5]") + "," + key(20, "[3,0,5]"));
  for (double frame : {2.5, 10.0, 17.5})
    EXPECT_LT(glm::distance(camera_on_path(path, frame).eye_world, dvec3(1 + frame / 10, 0, 5)), 1e-12);
}

TEST(CameraPath, KeysInOnePlaceStayThere) {
  const CameraPath path =
      read_path(key(1, "[1,2,3]") + "," + key(5, "[1,2,3]") + "," + key(9, "[4,2,3]") + "," + key(12, "[4,2,3]"));
  EXPECT_EQ(camera_on_path(path, 3).eye_world, dvec3(1, 2, 3));
  EXPECT_TRUE(all_finite(camera_on_path(path, 7).eye_world));
  EXPECT_EQ(camera_on_path(path, 11).eye_world, dvec3(4, 2, 3));
}

TEST(CameraPath, FieldOfViewDoesNotOvershoot) {
  const CameraPath path = read_path(kFour);  // 45, 60, 60, 20
  for (double frame = 1; frame <= 41; frame += 0.25) {
    const double fov = camera_on_path(path, frame).fov_y_rad * 180 / kPi;
    EXPECT_LE(fov, 60 + 1e-9) << frame;
    EXPECT_GE(fov, 20 - 1e-9) << frame;
    if (frame >= 11 && frame <= 31) {
      EXPECT_NEAR(fov, 60, 1e-9) << "between equal keys nothing moves";
    }
  }
}

TEST(CameraPath, UpIsUnitAndTurns) {
  const CameraPath path = read_path(key(1, "[0,0,9]", ",\"up\":[0,5,0]") + "," + key(3, "[0,0,9]", ",\"up\":[2,0,0]"));
  const dvec3 up = camera_on_path(path, 2).up;
  EXPECT_NEAR(glm::length(up), 1, 1e-12);
  EXPECT_NEAR(up.x, up.y, 1e-12);
  const CameraPath flip = read_path(key(1, "[0,0,9]") + "," + key(3, "[0,0,9]", ",\"up\":[0,-1,0]"));
  EXPECT_NEAR(glm::length(camera_on_path(flip, 2).up), 1, 1e-12) << "opposite keys";
}

TEST(CameraPath, OneKeyIsAStillCamera) {
  const CameraPath path = read_path(key(7, "[3,4,5]"));
  EXPECT_EQ(camera_on_path(path, 1).eye_world, dvec3(3, 4, 5));
  EXPECT_EQ(camera_on_path(path, 100).eye_world, dvec3(3, 4, 5));
}

TEST(CameraPath, LightMovesWithTheKeysThatHaveOne) {
  EXPECT_FALSE(light_on_path(read_path(kFour), 5));
  const CameraPath path = read_path(key(1, "[0,0,9]", ",\"light\":[0,3,0]") + "," + key(5, "[1,0,9]") + "," +
                                    key(9, "[2,0,9]", ",\"light\":[4,0,0]"));
  EXPECT_EQ(light_on_path(path, 0), dvec3(0, 1, 0));
  EXPECT_EQ(light_on_path(path, 20), dvec3(1, 0, 0));
  const dvec3 middle = *light_on_path(path, 5);
  EXPECT_NEAR(middle.x, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(middle.y, std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace hybridrt
