// Meshes whose topology is known on paper.

#include "core/mesh/topology.h"

#include "tests/support/obj_test.h"
#include "tests/support/topology_scenes.h"

namespace hybridrt {
namespace {

struct Counts {
  size_t components, boundary, inconsistent, non_manifold;
  bool operator==(const Counts&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << c.components << " components, " << c.boundary << " boundary, " << c.inconsistent << " inconsistent, "
             << c.non_manifold << " non-manifold";
}

Counts counts(const Topology& t) {
  return {t.components.size(), t.boundary_edges, t.inconsistent_edges, t.non_manifold_edges};
}

TEST(Topology, SphereIsClosedAndOutward) {
  const Topology t = topology_of(sphere_scene(17, 31));
  EXPECT_EQ(counts(t), (Counts{1, 0, 0, 0}));
  const size_t triangles = t.component_of_triangle.size(), vertices = 2 + 16 * 31;
  EXPECT_EQ(vertices + triangles, t.edges.size() + 2);  // Euler
  ASSERT_TRUE(t.components[0].closed());
  EXPECT_EQ(t.components[0].triangles, triangles);
  EXPECT_EQ(t.components[0].winding, Winding::outward);
  EXPECT_NEAR(t.components[0].volume, 4 * kPi / 3, 0.1);
}

TEST(Topology, CubeOfQuads) {
  const Topology t = topology_of(load_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n"
                                           "v 1 1 1\nf 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\n"
                                           "f 5 6 8 7\n")
                                     .scene);
  EXPECT_EQ(counts(t), (Counts{1, 0, 0, 0}));
  EXPECT_EQ(t.edges.size(), 12u + 6);
  EXPECT_EQ(t.components[0].winding, Winding::outward);
  EXPECT_DOUBLE_EQ(t.components[0].volume, 1);
}

TEST(Topology, EdgesKnowTheirTrianglesAndDirections) {
  const Scene scene = bare_scene({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {3, 2, 1}});
  const Topology t = topology_of(scene);
  ASSERT_EQ(t.edges.size(), 5u);
  ASSERT_EQ(t.first_use.size(), 6u);
  EXPECT_EQ(t.edges[2].a, 1u);
  EXPECT_EQ(t.edges[2].b, 2u);
  EXPECT_EQ(t.kind_of(2), EdgeKind::regular);
  ASSERT_EQ(t.uses_of(2).size(), 2u);
  EXPECT_EQ(t.uses_of(2)[0].triangle, 0u);
  EXPECT_EQ(t.uses_of(2)[0].reversed, 0u);
  EXPECT_EQ(t.uses_of(2)[1].triangle, 1u);
  EXPECT_EQ(t.uses_of(2)[1].reversed, 1u);
  for (size_t edge : {0, 1, 3, 4}) EXPECT_EQ(t.kind_of(edge), EdgeKind::boundary);
}

TEST(Topology, MoebiusStripHasOneBoundaryAndNoOrientation) {
  constexpr uint32_t kQuads = 20;
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  for (uint32_t i = 0; i < kQuads; ++i) {
    const double around = 2 * kPi * i / kQuads;
    for (double side : {-0.3, 0.3}) {
      const double radius = 1 + side * std::cos(around / 2);
      positions.emplace_back(radius * std::cos(around), radius * std::sin(around), side * std::sin(around / 2));
    }
    const uint32_t a = 2 * i, b = a + 1;
    const bool last = i + 1 == kQuads;
    const uint32_t c = last ? 1 : a + 2, d = last ? 0 : a + 3;  // the twist
    triangles.push_back({a, c, b});
    triangles.push_back({b, c, d});
  }
  const Topology t = topology_of(bare_scene(positions, triangles));
  EXPECT_EQ(counts(t), (Counts{1, 2 * kQuads, 1, 0}));
  EXPECT_FALSE(t.components[0].oriented());
  EXPECT_FALSE(t.components[0].closed());
  EXPECT_EQ(t.components[0].winding, Winding::none);
}

TEST(Topology, CubesThatShareAnEdgeAreOneOpenComponent) {
  Scene scene = cube_scene();
  add_cube(scene, {1, 1, 0});
  const Topology t = topology_of(scene);
  EXPECT_EQ(counts(t), (Counts{1, 0, 0, 1}));
  EXPECT_FALSE(t.components[0].closed());
  EXPECT_EQ(t.components[0].non_manifold_edges, 1u);
  EXPECT_EQ(t.components[0].triangles, 24u);
}

TEST(Topology, CubesThatShareAVertexAreTwoClosedComponents) {
  Scene scene = cube_scene();
  add_cube(scene, {1, 1, 1});
  const Topology t = topology_of(scene);
  EXPECT_EQ(counts(t), (Counts{2, 0, 0, 0}));
  EXPECT_TRUE(t.components[0].closed());
  EXPECT_TRUE(t.components[1].closed());
  EXPECT_EQ(t.components[1].first_triangle, 12u);
  EXPECT_EQ(t.component_of(23).first_triangle, 12u);
}

TEST(Topology, FlippedFaceIsInconsistent) {
  Scene scene = cube_scene();
  std::swap(scene.triangle_positions[5].x, scene.triangle_positions[5].y);
  const Topology t = topology_of(scene);
  EXPECT_EQ(counts(t), (Counts{1, 0, 3, 0}));
  EXPECT_FALSE(t.components[0].closed());
}

TEST(Topology, InwardBox) {
  Scene scene = cube_scene();
  for (uvec3& triangle : scene.triangle_positions) std::swap(triangle.x, triangle.y);
  const Topology t = topology_of(scene);
  EXPECT_EQ(counts(t), (Counts{1, 0, 0, 0}));
  EXPECT_EQ(t.components[0].winding, Winding::inward);
  EXPECT_DOUBLE_EQ(t.components[0].volume, 1);
}

TEST(Topology, VolumeOfASmallBodyFarAway) {
  Scene scene = sphere_scene(8, 9);
  const double near = topology_of(scene).components[0].volume;
  for (vec3& p : scene.positions) p = vec3(4096, -8192, 2048) + glm::round(p * 256.f) / 1024.f;
  const Component far = topology_of(scene).components[0];
  EXPECT_EQ(far.winding, Winding::outward);
  EXPECT_NEAR(far.volume * 64, near, 0.02 * near);
}

TEST(Topology, DuplicatedFaces) {
  Scene scene = cube_scene();
  scene.triangle_positions.push_back(scene.triangle_positions[3]);
  scene.triangle_materials.push_back(0);
  EXPECT_EQ(counts(topology_of(scene)), (Counts{1, 0, 0, 3}));

  const std::vector<vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(counts(topology_of(bare_scene(corners, {{0, 1, 2}, {1, 2, 0}}))), (Counts{1, 0, 3, 0}));
  const Topology two_sided = topology_of(bare_scene(corners, {{0, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(counts(two_sided), (Counts{1, 0, 0, 0}));
  EXPECT_TRUE(two_sided.components[0].closed());
  EXPECT_EQ(two_sided.components[0].winding, Winding::none);
  EXPECT_EQ(two_sided.components[0].volume, 0);
}

TEST(Topology, OwnVerticesAreWelded) {
  const Scene shared = sphere_scene(9, 13);
  const Topology welded = topology_of(shared), own = topology_of(with_own_vertices(shared));
  EXPECT_EQ(counts(own), counts(welded));
  EXPECT_EQ(own.edges.size(), welded.edges.size());
  EXPECT_DOUBLE_EQ(own.components[0].volume, welded.components[0].volume);

  Scene signs = with_own_vertices(cube_scene());
  for (size_t i = 0; i < signs.positions.size(); i += 2)
    for (int axis = 0; axis < 3; ++axis)
      if (signs.positions[i][axis] == 0) signs.positions[i][axis] = -0.f;
  EXPECT_TRUE(topology_of(signs).components[0].closed());
}

TEST(Topology, DegenerateTrianglesHaveNoEdges) {
  Scene scene = cube_scene();
  scene.positions.push_back(scene.positions[1]);
  for (const uvec3& corners : {uvec3(0, 0, 0), uvec3(3, 3, 4), uvec3(1, 8, 2)}) {
    scene.triangle_positions.push_back(corners);
    scene.triangle_materials.push_back(0);
  }
  const Topology t = topology_of(scene);
  EXPECT_EQ(counts(t), (Counts{4, 0, 0, 0}));
  EXPECT_EQ(t.edges.size(), 18u);
  EXPECT_TRUE(t.components[0].closed());
  for (uint32_t triangle : {12, 13, 14}) {
    EXPECT_TRUE(t.component_of(triangle).degenerate);
    EXPECT_FALSE(t.component_of(triangle).closed());
  }
}

TEST(Topology, NothingAtAll) {
  const Topology t = topology_of(bare_scene({}, {}));
  EXPECT_EQ(counts(t), (Counts{0, 0, 0, 0}));
  EXPECT_EQ(t.first_use.size(), 1u);
}

TEST(Topology, FanAroundOneVertex) {
  constexpr uint32_t kBlades = 5000;
  std::vector<vec3> positions{{0, 0, 0}};
  std::vector<uvec3> triangles;
  for (uint32_t i = 0; i < kBlades; ++i) {
    positions.emplace_back(std::cos(i), std::sin(i), i);
    triangles.push_back({0, 1 + i, 1 + (i + 1) % kBlades});
  }
  EXPECT_EQ(counts(topology_of(bare_scene(positions, triangles))), (Counts{1, kBlades, 0, 0}));
  for (uvec3& triangle : triangles) triangle = {0, 1, triangle.z};  // all at one edge
  triangles.pop_back();
  EXPECT_EQ(topology_of(bare_scene(positions, triangles)).non_manifold_edges, 1u);
}

}  // namespace
}  // namespace hybridrt
