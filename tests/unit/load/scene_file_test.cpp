#include "core/load/scene_file.h"

#include "tests/support/load_scene.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

using std::string;

struct SceneFile : testing::Test {
  TemporaryFolder folder;
  Warnings warnings;

  SceneSource read(const string& text) { return read_scene_file(folder.write("s.json", text)); }
  string failure(const string& text) {
    try {
      read(text);
      scene_file_camera(read_scene_file(folder.path / "s.json"), UpAxis::y, warnings);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return error.what();
    }
    ADD_FAILURE() << "read without an error: " << text;
    return "";
  }
  /// The failure of a scene JSON with a mesh and `more`.
  string failure_of(const string& more) { return failure(R"({"meshes":["a.obj"],)" + more + "}"); }
};

TEST_F(SceneFile, ReadsEverything) {
  const SceneSource scene = read(R"({"meshes":["a.obj","sub/../b.PLY"],"up_axis":"z",
    "lights":[{"type":"directional","toward":[0,0,4],"color":[1,0.5,0.25]},{"type":"directional","toward":[-9,0,0],"shadow":false}],
    "ambient":[0.1,0.2,0.3],"background":0.5,"glass":["pane","lens"],"opaque":["wall"],
    "settings":{"size":"64x48","reflection-depth":2,"fov":40.5,"require-hardware":true,"aov":["id","depth"],"light":[1,2,3],
                "camera":"c.json"}})");
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0], folder.path / "a.obj");
  EXPECT_EQ(scene.meshes[1], folder.path / "b.PLY");
  EXPECT_EQ(scene.up_axis, UpAxis::z);
  ASSERT_EQ(scene.lights->size(), 2u);
  EXPECT_EQ(scene.lights->at(0).toward, dvec3(0, 0, 1));
  EXPECT_EQ(scene.lights->at(0).color, vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(scene.lights->at(1).toward, dvec3(-1, 0, 0));
  EXPECT_EQ(scene.lights->at(1).color, vec3(1));
  EXPECT_TRUE(scene.lights->at(0).casts_shadow);
  EXPECT_FALSE(scene.lights->at(1).casts_shadow);
  EXPECT_EQ(scene.ambient, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(scene.background, vec3(0.5f));
  EXPECT_EQ(scene.kinds.glass, (std::vector<string>{"pane", "lens"}));
  EXPECT_EQ(scene.kinds.opaque, (std::vector<string>{"wall"}));
  const auto value_of = [&](const string& name) {
    for (const auto& [key, value] : scene.settings)
      if (key == name) return value;
    return string("?");
  };
  EXPECT_EQ(value_of("size"), "64x48");
  EXPECT_EQ(value_of("reflection-depth"), "2");
  EXPECT_EQ(value_of("fov"), "40.5");
  EXPECT_EQ(value_of("require-hardware"), "true");
  EXPECT_EQ(value_of("aov"), "id,depth");
  EXPECT_EQ(value_of("light"), "1,2,3");
  EXPECT_EQ(value_of("camera"), (folder.path / "c.json").string()) << "beside the scene";
}

TEST_F(SceneFile, WhatIsNotSaidIsLeftOpen) {
  const SceneSource scene = read(R"({"meshes":["a.obj"]})");
  EXPECT_FALSE(scene.up_axis || scene.lights || scene.ambient || scene.background);
  EXPECT_TRUE(scene.settings.empty());
  EXPECT_FALSE(scene_file_camera(read_scene_file(folder.path / "s.json"), UpAxis::y, warnings));
}

TEST_F(SceneFile, AnEmptyListMeansNoLight) {
  const SceneSource scene = read(R"({"meshes":["a.obj"],"lights":[]})");
  ASSERT_TRUE(scene.lights);
  EXPECT_TRUE(scene.lights->empty());
}

TEST_F(SceneFile, HasACameraOrAPathOrTheNameOfOne) {
  const auto course = [&](const string& text) {
    return *scene_file_camera(read(R"({"meshes":["a.obj"],)" + text + "}"), UpAxis::z, warnings);
  };
  const auto still = std::get<Camera>(course(R"("camera":{"eye":[1,2,3],"target":[0,0,0],"up":[0,0,1]})"));
  EXPECT_EQ(still.eye_world, dvec3(1, 3, -2)) << "in the axes of the files";
  EXPECT_EQ(still.up, dvec3(0, 1, 0));
  EXPECT_EQ(still.fov_y_rad, Camera().fov_y_rad);
  EXPECT_EQ(std::get<Orbit>(course(R"("camera_path":{"orbit":{"target":[0,0,0],"radius":3}})")).radius, 3);
  folder.write("shot.json", R"({"orbit":{"target":[0,0,0],"radius":4}})");
  EXPECT_EQ(std::get<Orbit>(course(R"("camera_path":"shot.json")")).radius, 4);
}

TEST_F(SceneFile, RefusesWhatItDoesNotKnow) {
  EXPECT_TRUE(contains(failure("{}"), "'meshes' is missing"));
  EXPECT_TRUE(contains(failure(R"({"meshes":[]})"), "there are no meshes"));
  EXPECT_TRUE(contains(failure(R"({"meshes":["a.blend"]})"), "meshes[0]: 'a.blend' is not an .obj, .ply"));
  EXPECT_TRUE(contains(failure(R"({"meshes":"a.obj"})"), "meshes: must be an array"));
  EXPECT_TRUE(contains(failure_of(R"("mesh":1)"), "unknown key 'mesh'"));
  EXPECT_TRUE(contains(failure_of(R"("up_axis":"x")"), "up_axis: 'x' is not known"));
  EXPECT_TRUE(contains(failure_of(R"("ambient":[1,2])"), "ambient: must be three numbers"));
  EXPECT_TRUE(contains(failure_of(R"("background":[-1,0,0])"), "background: a colour's parts"));
  EXPECT_TRUE(contains(failure_of(R"("glass":"pane")"), "glass"));
  EXPECT_TRUE(contains(failure_of(R"("opaque":[1])"), "opaque[0]"));
  EXPECT_TRUE(contains(failure_of(R"("glass":["a"],"opaque":["b","a"])"), "opaque[1]: 'a' is among 'glass' too"));
  for (const string type : {"point", "spot", "environment"})
    EXPECT_TRUE(contains(failure_of("\"lights\":[{\"type\":\"" + type + "\",\"position\":[0,1,0]}]"),
                         "lights[0].type: type '" + type + "' is not supported yet; directional lights are"));
  EXPECT_TRUE(contains(failure_of(R"("lights":[{"type":"laser"}])"), "'laser' is not known"));
  EXPECT_TRUE(contains(failure_of(R"("lights":[{"type":"directional","toward":[0,0,0]}])"), "must not be zero"));
  EXPECT_TRUE(contains(failure_of(R"("lights":[{"type":"directional","toward":[1,0,0],"size":1}])"),
                       "lights[0]: unknown key 'size'"));
  const string light = R"({"type":"directional","toward":[1,0,0]})";
  string lights = light;
  for (int i = 1; i < 8; ++i) lights += "," + light;
  EXPECT_EQ(read(R"({"meshes":["a.obj"],"lights":[)" + lights + "]}").lights->size(), 8u);
  EXPECT_TRUE(
      contains(failure_of("\"lights\":[" + lights + "," + light + "]"), "lights: there are 9 lights; at most 8"));
  EXPECT_TRUE(contains(failure_of(R"("settings":{"size":{}})"), "settings.size: must be"));
  EXPECT_TRUE(
      contains(failure_of(R"("camera":{"eye":[0,0,1],"target":[0,0,0],"fov":3})"), "camera: unknown key 'fov'"));
  EXPECT_TRUE(
      contains(failure_of(R"("camera":{"eye":[0,0,1],"target":[0,0,0]},"camera_path":"x.json")"), "give either"));
  EXPECT_TRUE(contains(failure_of(R"("camera_path":"gone.json")"), "gone.json cannot be opened"));
}

TEST_F(SceneFile, LoadsAsAScene) {
  folder.write("a.obj", kTriangle + "f 1 2 3\n");
  const string path = folder.write("s.json", R"({"meshes":["a.obj","a.obj"],"up_axis":"z"})").string();
  ThreadPool pool(2);
  EXPECT_EQ(load_scene(path, pool, warnings).vertex(1, 2), vec3(0, 0, -1));
  EXPECT_EQ(load_scene(path, pool, warnings, UpAxis::y).vertex(1, 2), vec3(0, 1, 0)) << "the command line wins";
  EXPECT_THROW(load_scene("scene:spheres,triangles=300", pool, warnings, UpAxis::z), Error);
}

}  // namespace
}  // namespace hybridrt
