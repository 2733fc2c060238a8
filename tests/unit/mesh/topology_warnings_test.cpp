#include "core/mesh/topology_warnings.h"

#include "tests/support/obj_test.h"
#include "tests/support/topology_scenes.h"

namespace hybridrt {
namespace {

Material glass(float ni) {
  Material material;
  material.name = "pane";
  material.illum = 6;
  material.ni = ni;
  resolve_material(material);
  return material;
}

Warnings warnings_of(const Scene& scene) {
  Warnings warnings;
  topology_warnings(scene, topology_of(scene), warnings);
  return warnings;
}

TEST(TopologyWarnings, ClosedGlassAndOpenPaintAreFine) {
  Scene scene = cube_scene();
  scene.materials.push_back(glass(1.5f));
  scene.triangle_materials.assign(12, 1);
  EXPECT_TRUE(warnings_of(scene).empty());
  scene.triangle_materials.assign(12, 0);
  scene.triangle_positions.pop_back();
  scene.triangle_materials.pop_back();
  EXPECT_TRUE(warnings_of(scene).empty());
}

TEST(TopologyWarnings, OpenGlass) {
  Scene scene = cube_scene();
  add_cube(scene, vec3(3));
  scene.materials.push_back(glass(1.5f));
  scene.triangle_materials.assign(24, 1);
  scene.triangle_positions.pop_back();
  scene.triangle_materials.pop_back();
  EXPECT_TRUE(warned(warnings_of(scene), "11 triangles in 1 open components refract (first: material 'pane')"));
  scene.materials[1] = glass(1);
  EXPECT_TRUE(warnings_of(scene).empty()) << "light goes straight on";
}

TEST(TopologyWarnings, NonManifoldEdgesAreCounted) {
  Scene scene = cube_scene();
  add_cube(scene, {1, 1, 0});
  add_cube(scene, {2, 2, 0});
  EXPECT_TRUE(warned(warnings_of(scene), "2 edges belong to more than two triangles"));
}

}  // namespace
}  // namespace hybridrt
