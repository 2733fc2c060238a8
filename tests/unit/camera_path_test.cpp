#include "core/scene/camera_path.h"

#include <cctype>

#include "core/render/motion.h"
#include "core/scene/view.h"
#include "tests/unit/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

CameraCourse read_text(std::string_view text, Warnings& warnings, UpAxis up = UpAxis::y) {
  const TemporaryFolder folder;
  return read_camera_file(folder.write("shot.json", text), {up, kPi / 4}, warnings);
}

CameraPath read_path(const string& keys, UpAxis up = UpAxis::y) {
  Warnings warnings;
  return std::get<CameraPath>(read_text("{\"keyframes\":[" + keys + "]}", warnings, up));
}

string camera_error(std::string_view text) {
  Warnings warnings;
  try {
    read_text(text, warnings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_EQ(string(error.what()).find('\n'), string::npos) << "one line only";
    return error.what();
  }
  ADD_FAILURE() << "read without an error: " << text;
  return "";
}

string key(int frame, const string& eye, const string& more = "") {
  return "{\"frame\":" + std::to_string(frame) + ",\"eye\":" + eye + ",\"target\":[0,0,0]" + more + "}";
}

const string kFour = key(1, "[0,0,10]") + "," + key(11, "[10,0,0]", ",\"fov_y_deg\":60") + "," +
                     key(31, "[10,5,-10]", ",\"fov_y_deg\":60") + "," +
                     key(41, "[0,0,-10]", ",\"fov_y_deg\":20");

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
  const CameraPath path = read_path(key(1, "[1,2,3]") + "," + key(5, "[1,2,3]") + "," + key(9, "[4,2,3]") +
                                    "," + key(12, "[4,2,3]"));
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
  const CameraPath path =
      read_path(key(1, "[0,0,9]", ",\"up\":[0,5,0]") + "," + key(3, "[0,0,9]", ",\"up\":[2,0,0]"));
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

TEST(CameraPath, NumbersAreInTheAxesOfTheFiles) {
  const CameraPath path = read_path(key(1, "[1,2,3]", ",\"up\":[0,0,1],\"light\":[0,0,2]"), UpAxis::z);
  EXPECT_EQ(path.keys[0].camera.eye_world, dvec3(1, 3, -2));
  EXPECT_EQ(path.keys[0].camera.up, dvec3(0, 1, 0));
  EXPECT_EQ(path.keys[0].light_toward, dvec3(0, 1, 0));
}

TEST(CameraPath, ReadsAnOrbit) {
  Warnings warnings;
  const auto orbit = std::get<Orbit>(read_text(
      R"({"orbit":{"target":[1,2,3],"radius":4,"height":-1,"from_deg":90,"to_deg":-90}})", warnings));
  EXPECT_EQ(orbit.target_world, dvec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(orbit.from_rad, kPi / 2);
  EXPECT_DOUBLE_EQ(orbit.to_rad, -kPi / 2);
  const CameraMotion motion{orbit, {1, 4, 1}};
  EXPECT_LT(glm::distance(camera_at(motion, 1).eye_world, dvec3(5, 1, 3)), 1e-12);
  EXPECT_LT(glm::distance(camera_at(motion, 3).eye_world, dvec3(1, 1, 7)), 1e-12) << "half way";
  const auto whole =
      std::get<Orbit>(read_text(R"({"orbit":{"target":[0,0,0],"radius":4,"from_deg":10}})", warnings));
  EXPECT_NEAR(whole.to_rad - whole.from_rad, 2 * kPi, 1e-12) << "one turn from wherever it starts";
}

TEST(CameraPath, UpAlongTheViewIsOneWarning) {
  Warnings warnings;
  read_text(
      "{\"keyframes\":[" + key(1, "[0,5,0]") + "," + key(2, "[0,-5,0]") + "," + key(3, "[0,0,5]") + "]}",
      warnings);
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warned(warnings, "2 keys look along their up direction (first: frame 1)"));
}

TEST(CameraPath, RefusesWhatItCannotMean) {
  const auto keys = [](const string& k) { return camera_error("{\"keyframes\":[" + k + "]}"); };
  EXPECT_TRUE(contains(keys(""), "no keys"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,0]")), "keyframes[0]: eye and target are the same point"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,1]", ",\"fov_y_deg\":0")), "keyframes[0].fov_y_deg: 0: allowed"));
  EXPECT_TRUE(contains(keys(key(1, "[0,0,1]", ",\"fov_y_deg\":180")), "fov_y_deg: 180"));
  EXPECT_TRUE(
      contains(keys(key(5, "[0,0,1]") + "," + key(5, "[0,1,1]")), "keyframes[1]: frame 5 is there twice"));
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
  EXPECT_TRUE(
      contains(camera_error(R"({"orbit":{"target":[0,0,0],"radius":0}})"), "radius: must be more than 0"));
}

TEST(CameraPath, SaysWhereTheTextIsNotJson) {
  EXPECT_TRUE(contains(camera_error("{\n  \"keyframes\": [,]\n}"), "shot.json:2:17: not JSON"));
  EXPECT_TRUE(contains(camera_error("{\"keyframes\":[{\"frame\":NaN}]}"), "shot.json:1:24: not JSON"));
  EXPECT_TRUE(contains(camera_error(""), "shot.json:1:1: not JSON"));
  EXPECT_TRUE(contains(camera_error("{\"keyframes\":[{\"frame\":1e999}]}"), "shot.json: "));
  EXPECT_TRUE(contains(camera_error(string(100000, '[')), "not JSON")) << "deep nesting is no stack overflow";
  Warnings warnings;
  EXPECT_THROW(read_camera_file("/nonexistent/shot.json", {}, warnings), Error);
  EXPECT_THROW(read_camera_file("/tmp", {}, warnings), Error);
}

TEST(LightMotion, FollowingLightIsStillAsSeenFromTheCamera) {
  Orbit orbit;
  orbit.radius = 5, orbit.height = 2;
  const CameraMotion motion{orbit, {1, 8, 1}};
  LightMotion light;
  light.lights = {{glm::normalize(dvec3(1, 2, 3))}};
  light.mode = LightMode::with_camera;
  const auto seen = [&](int frame) {
    const View view = make_view(camera_at(motion, frame), dvec3(0), 4, 3);
    const dvec3 toward = lights_at(light, motion, frame)[0].toward;
    return dvec3(glm::dot(view.right, toward), glm::dot(view.up, toward), glm::dot(view.forward, toward));
  };
  EXPECT_EQ(lights_at(light, motion, 1)[0].toward, light.lights[0].toward);
  for (int frame = 2; frame <= 8; ++frame) {
    EXPECT_LT(glm::distance(seen(frame), seen(1)), 1e-12) << frame;
    EXPECT_GT(glm::distance(lights_at(light, motion, frame)[0].toward, light.lights[0].toward), 0.1) << "it moved";
    EXPECT_NEAR(lights_at(light, motion, frame)[0].toward.y, light.lights[0].toward.y, 1e-12)
        << "a turn about the up axis";
  }
  light.mode = LightMode::fixed;
  EXPECT_EQ(lights_at(light, motion, 5)[0].toward, light.lights[0].toward);
}

}  // namespace
}  // namespace hybridrt
