#include "core/load/camera_json.h"

#include <gtest/gtest.h>

#include "core/render/motion.h"
#include "tests/support/camera_text.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

string camera_error(std::string_view text) {
  Warnings warnings;
  try {
    read_camera_text(text, warnings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_EQ(string(error.what()).find('\n'), string::npos) << "one line only";
    return error.what();
  }
  ADD_FAILURE() << "read without an error: " << text;
  return "";
}

TEST(CameraJson, NumbersAreInTheAxesOfTheFiles) {
  const CameraPath path = read_path(key(1, "[1,2,3]", ",\"up\":[0,0,1],\"light\":[0,0,2]"), UpAxis::z);
  EXPECT_EQ(path.keys[0].camera.eye_world, dvec3(1, 3, -2));
  EXPECT_EQ(path.keys[0].camera.up, dvec3(0, 1, 0));
  EXPECT_EQ(path.keys[0].light_toward, dvec3(0, 1, 0));
}

TEST(CameraJson, ReadsAnOrbit) {
  Warnings warnings;
  const auto orbit = std::get<Orbit>(
      read_camera_text(R"({"orbit":{"target":[1,2,3],"radius":4,"height":-1,"from_deg":90,"to_deg":-90}})", warnings));
  EXPECT_EQ(orbit.target_world, dvec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(orbit.from_rad, kPi / 2);
  EXPECT_DOUBLE_EQ(orbit.to_rad, -kPi / 2);
  const CameraMotion motion{orbit, {1, 4, 1}};
  EXPECT_LT(glm::distance(camera_at(motion, 1).eye_world, dvec3(5, 1, 3)), 1e-12);
  EXPECT_LT(glm::distance(camera_at(motion, 3).eye_world, dvec3(1, 1, 7)), 1e-12) << "half way";
  const auto whole =
      std::get<Orbit>(read_camera_text(R"({"orbit":{"target":[0,0,0],"radius":4,"from_deg":10}})", warnings));
  EXPECT_NEAR(whole.to_rad - whole.from_rad, 2 * kPi, 1e-12) << "one turn from wherever it starts";
}

TEST(CameraJson, UpAlongTheViewIsOneWarning) {
  Warnings warnings;
  read_camera_text("{\"keyframes\":[" + key(1, "[0,5,0]") + "," + key(2, "[0,-5,0]") + "," + key(3, "[0,0,5]") + "]}",
                   warnings);
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warned(warnings, "2 keys look along their up direction (first: frame 1)"));
}

TEST(CameraJson, RefusesWhatItCannotMean) {
  const auto keys = [](const string& k) { return camera_error("{\"keyframes\":[" + k + "]}"); };
  EXPECT_TRUE(contains(keys(""), "no keys"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,0]")), "keyframes[0]: eye and target are the same point"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,1]", ",\"fov_y_deg\":0")), "keyframes[0].fov_y_deg: 0: must be"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,1]", ",\"fov_y_deg\":180")), "fov_y_deg: 180"));
  EXPECT_TRUE(contains(keys(key(5, "[0,0,1]") + "," + key(5, "[0,1,1]")), "keyframes[1]: frame 5 is there twice"));
  EXPECT_TRUE(contains(keys(key(5, "[0,0,1]") + "," + key(4, "[0,1,1]")), "frame 4 comes after frame 5"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,1]", ",\"fow\":3")), "unknown key 'fow'"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,\"a\"]")), "keyframes[0].eye[2]: must be a number"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0]")), "keyframes[0].eye: must be three numbers"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,1e300]")), "must be below 1e30"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,1]", ",\"up\":[0,0,0]")), "up: must not be zero"));
  EXPECT_TRUE(contains(keys("{\"frame\":1,\"eye\":[0,0,1]}"), "'target' is missing"));
  EXPECT_TRUE(contains(keys("3"), "keyframes[0]: must be an object"));
  EXPECT_TRUE(contains(camera_error("{}"), "give either 'keyframes' or 'orbit'"));
  EXPECT_TRUE(contains(camera_error("[]"), "must be an object"));
  EXPECT_TRUE(contains(camera_error(R"({"orbit":{"target":[0,0,0],"radius":0}})"), "radius: must be more than 0"));
}

TEST(CameraJson, SaysWhereTheTextIsNotJson) {
  EXPECT_TRUE(contains(camera_error("{\n  \"keyframes\": [,]\n}"), "shot.json:2:17: not JSON"));
  EXPECT_TRUE(contains(camera_error("{\"keyframes\":[{\"frame\":NaN}]}"), "shot.json:1:24: not JSON"));
  EXPECT_TRUE(contains(camera_error(""), "shot.json:1:1: not JSON"));
  EXPECT_TRUE(contains(camera_error("{\"keyframes\":[{\"frame\":1e999}]}"), "shot.json: "));
  EXPECT_TRUE(contains(camera_error(string(100000, '[')), "not JSON")) << "deep nesting is no stack overflow";
  Warnings warnings;
  EXPECT_THROW(read_camera_file("/nonexistent/shot.json", {}, warnings), Error);
  EXPECT_THROW(read_camera_file("/tmp", {}, warnings), Error);
}

}  // namespace
}  // namespace hybridrt
