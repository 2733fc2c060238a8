// Scenes made by others, if they are available: counts against the list that came with them.

#include <fstream>

#include "tests/support/load_scene.h"
#include "tests/support/obj_test.h"

namespace hybridrt {
namespace {

struct Expected {
  const char* file;
  size_t triangles;     ///< those of the file minus those of zero area
  size_t materials;     ///< "default" included where it is used
  const char* warning;  ///< a part of one; null: none at all
};

class SharedScene : public testing::TestWithParam<Expected> {};

TEST_P(SharedScene, LoadsTheSameForAnyThreads) {
  const std::filesystem::path path = std::filesystem::path(HYBRIDRT_SHARED_SCENES) / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  ThreadPool one(1), three(3);
  Warnings warnings, again;
  const Scene scene = load_scene(path.string(), one, warnings);
  EXPECT_EQ(scene.triangle_count(), GetParam().triangles);
  EXPECT_EQ(scene.materials.size(), GetParam().materials);
  if (GetParam().warning)
    EXPECT_TRUE(warned(warnings, GetParam().warning)) << testing::PrintToString(warnings);
  else
    EXPECT_TRUE(warnings.empty()) << testing::PrintToString(warnings);

  const Scene same = load_scene(path.string(), three, again);
  EXPECT_EQ(same.positions, scene.positions);
  EXPECT_EQ(same.normals, scene.normals);
  EXPECT_EQ(same.triangle_normals, scene.triangle_normals);
  EXPECT_EQ(again, warnings);
}

const Expected kScenes[] = {
    {"sibenik/sibenik.obj", 75'284 - 7, 15, "7 triangles of zero area"},
    {"armadillo/armadillo.obj", 345'944, 1, nullptr},
    {"cornell_box/CornellBox-Original.obj", 36, 8, nullptr},
    {"cornell_box/CornellBox-Mirror.obj", 36, 8, nullptr},
    {"cornell_box/CornellBox-Empty-CO.obj", 12, 6, nullptr},
    {"cornell_box/CornellBox-Empty-RG.obj", 12, 6, nullptr},
    {"cornell_box/CornellBox-Empty-Squashed.obj", 12, 7, nullptr},
    {"cornell_box/CornellBox-Glossy.obj", 1112, 8, "2 triangles use materials that no MTL file defines ('light')"},
    {"cornell_box/CornellBox-Glossy-Floor.obj", 1112, 8, "('light')"},
    {"sports_car/sportsCar.obj", 300'603 - 104, 38, "104 triangles of zero area"},
    {"mori_knob/testObj.obj", 11'970, 5, nullptr},
    {"holodeck/holodeck.obj", 4015 - 8, 7, "4 triangles of zero area"},
    {"teapot/teapot.obj", 15'704, 1, nullptr},
    {"scrub_pine/scrubPine.obj", 527, 2, nullptr},
    {"delft_extent/extent_red.obj", 5399, 15, nullptr},
    {"nasty/concave_10gon/issue-319-003.obj", 8, 1, nullptr},
    {"nasty/vertex_colours/cube-vertexcol.obj", 12, 5, nullptr},
    {"nasty/mtllib_list/mtllib-multiple-files-issue-112.obj", 1, 1, "2 material files are missing"},
    {"nasty/usemtl_before_o/issue-235-usemtl-then-o.obj", 2, 2, nullptr},
    {"nasty/missing_mtl/missing_material_file.obj", 36, 1, "no MTL file defines"},
    {"nasty/texture_options/texture-options-issue-85.obj", 1, 3, "texture maps"},
    {"nasty/missing_attributes/box-missing-attributes.obj", 12, 1, "24 normal indices lead nowhere"},
    {"nasty/transparent_box/box-transparent.obj", 12, 1, nullptr},
    {"nasty/objects_groups_materials/box-objects-groups-materials.obj", 36, 3, nullptr},
    {"nasty/missing_texture/box-missing-texture.obj", 12, 1, "1 texture files are missing"},
    {"nasty/no_final_newline/box_without_lineending.obj", 12, 1, "('Default')"},
    {"nasty/points_lines_quads/testmixed.obj", 12, 1, "('Default')"},
    {"nasty/malformed_faces/malformed2.obj", 10, 1, "1 faces of fewer than three corners"},
    {"nasty/negative_indices_vn/negative_indices.obj", 12, 1, nullptr},
    {"nasty/quad_knot/quadknot.obj", 2880, 1, "1 material files are missing"},
    {"nasty/duplicate_vertices/duplicatevertices.obj", 5, 1, nullptr},
};
INSTANTIATE_TEST_SUITE_P(All, SharedScene, testing::ValuesIn(kScenes), [](const auto& scene) {
  std::string name = std::filesystem::path(scene.param.file).stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

TEST(SharedScenes, BrokenOnesAreRefused) {
  const std::filesystem::path nasty = std::filesystem::path(HYBRIDRT_SHARED_SCENES) / "nasty";
  if (!std::filesystem::exists(nasty)) GTEST_SKIP() << nasty << " is not here";
  EXPECT_TRUE(
      contains(error_of(file_contents(nasty / "index_past_end/invalid_index.obj")), ":12: a face uses vertex 7"));
  EXPECT_TRUE(
      contains(error_of(file_contents(nasty / "relative_texture_index/invalid-relative-texture-index.obj")), ":2: "));
  EXPECT_TRUE(
      contains(error_of(file_contents(nasty / "invalid_faces/invalid-face-definition.obj")), "none of its 2 faces"));
}

}  // namespace
}  // namespace hybridrt
