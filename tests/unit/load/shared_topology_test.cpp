// Scenes made by others, if they are available: edges against the list that came with them.

#include <algorithm>

#include "tests/support/load_scene.h"
#include "tests/support/obj_test.h"
#include "tests/support/topology_scenes.h"

namespace hybridrt {
namespace {

struct Expected {
  const char* file;
  size_t non_manifold, boundary;
};

class SharedTopology : public testing::TestWithParam<Expected> {};

TEST_P(SharedTopology, HasTheListedEdges) {
  const std::filesystem::path path = std::filesystem::path(HYBRIDRT_SHARED_SCENES) / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  ThreadPool pool(2);
  Warnings warnings;
  const Topology t = build_topology(load_scene(path.string(), pool, warnings), pool);
  EXPECT_EQ(t.non_manifold_edges, GetParam().non_manifold);
  EXPECT_EQ(t.boundary_edges, GetParam().boundary);
  const bool all_closed = std::all_of(t.components.begin(), t.components.end(),
                                      [](const Component& component) { return component.closed(); });
  EXPECT_EQ(all_closed, t.non_manifold_edges + t.boundary_edges + t.inconsistent_edges == 0);
}

// The list counts edges of the polygons as written. Ours are those of triangles: quads that occur twice share their
// diagonals too, and where a triangle of zero area was left out its neighbours have a border. So Original and Mirror
// have 2 more non-manifold edges, the sports car 915 (and 225 boundary edges), sibenik 13 boundary edges, the holodeck
// 8.
const Expected kScenes[] = {
    {"sibenik/sibenik.obj", 799, 8217},
    {"armadillo/armadillo.obj", 0, 0},
    {"cornell_box/CornellBox-Original.obj", 8, 14},
    {"cornell_box/CornellBox-Mirror.obj", 8, 14},
    {"cornell_box/CornellBox-Empty-CO.obj", 0, 8},
    {"cornell_box/CornellBox-Empty-RG.obj", 0, 8},
    {"cornell_box/CornellBox-Empty-Squashed.obj", 0, 8},
    {"cornell_box/CornellBox-Glossy.obj", 0, 8},
    {"cornell_box/CornellBox-Glossy-Floor.obj", 0, 8},
    {"sports_car/sportsCar.obj", 3419, 21535},
    {"mori_knob/testObj.obj", 0, 44},
    {"holodeck/holodeck.obj", 0, 147},
    {"teapot/teapot.obj", 0, 0},
    {"scrub_pine/scrubPine.obj", 1, 379},
    {"delft_extent/extent_red.obj", 32, 1993},
    {"nasty/duplicate_vertices/duplicatevertices.obj", 1, 2},
};
INSTANTIATE_TEST_SUITE_P(All, SharedTopology, testing::ValuesIn(kScenes), [](const auto& scene) {
  std::string name = std::filesystem::path(scene.param.file).stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

}  // namespace
}  // namespace hybridrt
