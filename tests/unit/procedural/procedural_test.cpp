#include "core/procedural/procedural.h"

#include <set>

#include "core/load/obj_writer.h"
#include "core/load/scene_json_writer.h"
#include "core/load/scene_source.h"
#include "core/mesh/weld.h"
#include "core/procedural/chess.h"
#include "core/procedural/thin.h"
#include "tests/support/closed_mesh.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

/// Chess and thin, by name.
class Procedural : public testing::TestWithParam<const char*> {
 protected:
  const ProceduralScene& scene() const { return *find_procedural(GetParam()); }
  Scene make(double triangles, std::optional<double> reflective = {}) const {
    SceneValues values = {{"triangles", triangles}};
    if (reflective) values["reflective"] = *reflective;
    return scene().make(values);
  }
};
INSTANTIATE_TEST_SUITE_P(Scenes, Procedural, testing::Values("chess", "thin"),
                         [](const auto& name) { return std::string(name.param); });

TEST_P(Procedural, IsClosedAndFacesOutwardAtAnySize) {
  for (const int64_t triangles : {10'000, 13'000, 37'000, 150'000, 400'000}) {
    SCOPED_TRACE(triangles);
    const Scene made = make(static_cast<double>(triangles));
    EXPECT_NEAR(static_cast<double>(made.triangle_count()), static_cast<double>(triangles), 0.05 * triangles);
    expect_closed(made);
    expect_outward(made);
  }
}

TEST_P(Procedural, MeetsTheCountFromEndToEnd) {
  for (double wanted = 10'000; wanted < 150'000; wanted *= 1.23)
    ASSERT_NEAR(static_cast<double>(make(std::floor(wanted), 10).triangle_count()), wanted, 0.05 * wanted);
}

TEST_P(Procedural, ComponentsDoNotTouch) {
  const Scene made = make(60'000);
  ThreadPool pool(1);
  const std::vector<uint32_t> same = weld_positions(made.positions, pool);
  for (uint32_t i = 0; i < same.size(); ++i) ASSERT_EQ(same[i], i) << "two vertices in one place";
}

TEST_P(Procedural, MirrorsAreNestedWholeComponents) {
  std::set<uint32_t> before;
  size_t components = 0;
  for (const double percent : {0.0, 0.01, 10.0, 30.0, 75.0, 100.0}) {
    const Scene made = make(12'000, percent);
    const std::vector<uint32_t> component = components_of(made);
    std::set<uint32_t> all, mirrors, others;
    for (uint32_t t = 0; t < made.triangle_count(); ++t) {
      const Material& m = made.material_of(t);
      const uint32_t c = component[made.triangle_positions[t].x];
      all.insert(c);
      (m.reflective() ? mirrors : others).insert(c);
      ASSERT_FALSE(m.transmissive());
      if (m.reflective()) {
        ASSERT_EQ(m.reflect, vec3(0.5f));
      }
    }
    EXPECT_EQ(mirrors.size() + others.size(), all.size()) << "whole components";
    EXPECT_TRUE(std::includes(mirrors.begin(), mirrors.end(), before.begin(), before.end()));
    const double wanted = percent * static_cast<double>(all.size()) / 100;
    // A knight's head or two may fall into several pieces when there are few triangles.
    EXPECT_NEAR(static_cast<double>(mirrors.size()), wanted == 0 ? 0 : std::max(1.0, wanted), 2);
    if (percent > 0) {
      EXPECT_GE(mirrors.size(), 1u);
    }
    before = mirrors, components = all.size();
  }
  EXPECT_EQ(before.size(), components);
}

TEST_P(Procedural, SameOptionsSameBytesAndReadsBack) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path / "a.obj", json = folder.path / "a.json";
  const Scene made = make(40'000);
  write_obj(made, path);
  write_scene_json(json, "a.obj", scene().shot({}));
  const std::string bytes = file_contents(path), json_bytes = file_contents(json);
  const Scene again = make(40'000);
  write_obj(again, path);
  write_scene_json(json, "a.obj", scene().shot({}));
  EXPECT_EQ(file_contents(path), bytes);
  EXPECT_EQ(file_contents(json), json_bytes);
  for (const char* part :
       {"\"meshes\"", "\"a.obj\"", "\"camera\"", "\"fov_y_deg\"", "\"directional\"", "\"background\""})
    EXPECT_TRUE(contains(json_bytes, part)) << json_bytes;

  ThreadPool pool(2);
  Warnings warnings;
  const Scene read = load_obj(path, pool, warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(read.positions, made.positions);
  EXPECT_EQ(read.normals, made.normals);
  EXPECT_EQ(read.triangle_positions, made.triangle_positions);
  EXPECT_EQ(read.triangle_normals, made.triangle_normals);
  EXPECT_EQ(read.triangle_materials, made.triangle_materials);
  ASSERT_EQ(read.materials.size(), made.materials.size());
  for (size_t i = 0; i < read.materials.size(); ++i) {
    const Material &a = read.materials[i], &b = made.materials[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.kd, b.kd);
    EXPECT_EQ(a.reflect, b.reflect);
    EXPECT_EQ(a.transmit, b.transmit);
    EXPECT_EQ(a.ni, b.ni);
    EXPECT_EQ(a.fresnel, b.fresnel);
  }
}

TEST_P(Procedural, HasAShot) {
  const SceneShot shot = scene().shot({});
  ASSERT_TRUE(shot.camera && shot.lights && shot.lights->size() == 1);
  EXPECT_NEAR(glm::length(shot.lights->front().toward), 1, 1e-12);
  EXPECT_GT(shot.camera->eye_world.y, 0);
}

TEST(ProceduralScenes, RefuseWhatIsOutOfRange) {
  for (const ProceduralScene& scene : procedural_scenes())
    for (const SceneParameter& parameter : scene.parameters) {
      check_value(scene, parameter, parameter.least);
      check_value(scene, parameter, parameter.most);
      for (const double bad : {std::nextafter(parameter.least, -INFINITY), std::nextafter(parameter.most, INFINITY),
                               double{NAN}, double{INFINITY}}) {
        try {
          check_value(scene, parameter, bad);
          ADD_FAILURE() << scene.name << " " << parameter.name << " " << bad;
        } catch (const Error& error) {
          EXPECT_EQ(error.kind(), ErrorKind::usage);
        }
      }
    }
}

TEST(Chess, IsOfWoodGlassAndMetalByDesign) {
  const Scene scene = make_chess({12'000, {}});
  int glass = 0, mirrors = 0, plain = 0;
  for (const Material& m : scene.materials) {
    glass += m.fresnel == Fresnel::dielectric;
    mirrors += m.reflective() && !m.transmissive();
    plain += !m.reflective() && !m.transmissive();
  }
  EXPECT_GE(glass, 2);
  EXPECT_GE(mirrors, 2);
  EXPECT_GE(plain, 1);
  EXPECT_EQ(scene.bounds.lo.y < 0 && scene.bounds.hi.y > 1.5, true);
}

}  // namespace
}  // namespace hybridrt
