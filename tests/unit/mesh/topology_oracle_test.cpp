// Random triangles against pairwise comparison, and against other numbers of threads.

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

#include "tests/support/topology_scenes.h"

namespace hybridrt {
namespace {

/// `triangles` over few places, so that sides meet often, with several vertices per place.
Scene random_soup(uint32_t seed, int places, int triangles) {
  std::mt19937 random(seed);
  std::vector<vec3> positions;
  for (int i = 0; i < 3 * places; ++i) {
    const int place = static_cast<int>(random() % places);
    positions.emplace_back(place % 5, place / 5 % 5, place / 25);
  }
  std::vector<uvec3> corners;
  for (int i = 0; i < triangles; ++i)
    corners.emplace_back(random() % positions.size(), random() % positions.size(), random() % positions.size());
  return bare_scene(std::move(positions), std::move(corners));
}

/// What meets at the side from `from` to `to`, found by looking at every side of all triangles.
struct Meeting {
  size_t along = 0, against = 0;
  uint32_t smallest = 0xFFFFFFFFu;
};

bool degenerate(const Scene& s, uint32_t t) {
  return s.vertex(t, 0) == s.vertex(t, 1) || s.vertex(t, 1) == s.vertex(t, 2) || s.vertex(t, 2) == s.vertex(t, 0);
}

template <typename Visit>
Meeting meet(const Scene& s, const vec3& from, const vec3& to, const Visit& visit) {
  Meeting meeting;
  for (uint32_t t = 0; t < s.triangle_count(); ++t)
    for (int k = 0; k < 3 && !degenerate(s, t); ++k) {
      const vec3 a = s.vertex(t, k), b = s.vertex(t, (k + 1) % 3);
      if (!(a == from && b == to) && !(a == to && b == from)) continue;
      a == from ? ++meeting.along : ++meeting.against;
      meeting.smallest = std::min(meeting.smallest, t);
      visit(t);
    }
  return meeting;
}

void expect_like_brute_force(const Scene& s, const Topology& t) {
  size_t boundary = 0, inconsistent = 0, non_manifold = 0, edges = 0;
  std::vector<uint32_t> label(s.triangle_count());
  for (uint32_t i = 0; i < label.size(); ++i) label[i] = i;
  for (bool changed = true, first = true; changed; first = false) {
    changed = false;
    for (uint32_t i = 0; i < s.triangle_count(); ++i)
      for (int k = 0; k < 3 && !degenerate(s, i); ++k) {
        const Meeting m = meet(s, s.vertex(i, k), s.vertex(i, (k + 1) % 3), [&](uint32_t other) {
          const uint32_t lower = std::min(label[i], label[other]);
          changed |= label[i] != lower || label[other] != lower;
          label[i] = label[other] = lower;
        });
        if (!first || m.smallest != i) continue;
        ++edges;
        boundary += m.along + m.against == 1;
        inconsistent += m.along + m.against == 2 && m.along != 1;
        non_manifold += m.along + m.against > 2;
      }
  }
  EXPECT_EQ(t.edges.size(), edges);
  EXPECT_EQ(t.boundary_edges, boundary);
  EXPECT_EQ(t.inconsistent_edges, inconsistent);
  EXPECT_EQ(t.non_manifold_edges, non_manifold);
  for (uint32_t i = 0; i < label.size(); ++i) EXPECT_EQ(t.component_of(i).first_triangle, label[i]);

  for (size_t edge = 0; edge < t.edges.size(); ++edge) {
    const vec3 a = s.positions[t.edges[edge].a], b = s.positions[t.edges[edge].b];
    std::vector<uint32_t> triangles;
    const Meeting m = meet(s, a, b, [&](uint32_t triangle) { triangles.push_back(triangle); });
    const std::span<const EdgeUse> uses = t.uses_of(edge);
    ASSERT_EQ(uses.size(), triangles.size());
    size_t reversed = 0;
    for (size_t i = 0; i < uses.size(); ++i) {
      EXPECT_EQ(uses[i].triangle, triangles[i]);
      reversed += uses[i].reversed;
    }
    EXPECT_EQ(reversed, m.against);
  }
  size_t of_components[4] = {};
  for (const Component& c : t.components) {
    of_components[0] += c.triangles, of_components[1] += c.boundary_edges;
    of_components[2] += c.inconsistent_edges, of_components[3] += c.non_manifold_edges;
  }
  EXPECT_EQ(of_components[0], s.triangle_count());
  EXPECT_EQ(of_components[1], boundary);
  EXPECT_EQ(of_components[2], inconsistent);
  EXPECT_EQ(of_components[3], non_manifold);
}

TEST(TopologyOracle, RandomSoups) {
  for (uint32_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const int places = 4 + static_cast<int>(seed % 40), triangles = 1 + static_cast<int>(seed * 7 % 60);
    const Scene scene = random_soup(seed, places, triangles);
    expect_like_brute_force(scene, topology_of(scene, 1 + seed % 3));
    if (HasFailure()) return;
  }
}

void expect_same(const Topology& a, const Topology& b) {
  EXPECT_EQ(a.component_of_triangle, b.component_of_triangle);
  EXPECT_EQ(a.first_use, b.first_use);
  const auto same_edge = [](const Edge& x, const Edge& y) { return x.a == y.a && x.b == y.b; };
  EXPECT_TRUE(std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(), same_edge));
  const auto same_use = [](const EdgeUse& x, const EdgeUse& y) {
    return x.triangle == y.triangle && x.reversed == y.reversed;
  };
  EXPECT_TRUE(std::equal(a.uses.begin(), a.uses.end(), b.uses.begin(), b.uses.end(), same_use));
  const auto same_component = [](const Component& x, const Component& y) {
    return x.first_triangle == y.first_triangle && x.triangles == y.triangles && x.winding == y.winding &&
           x.boundary_edges == y.boundary_edges && x.inconsistent_edges == y.inconsistent_edges &&
           x.non_manifold_edges == y.non_manifold_edges && x.volume == y.volume && x.degenerate == y.degenerate;
  };
  EXPECT_TRUE(
      std::equal(a.components.begin(), a.components.end(), b.components.begin(), b.components.end(), same_component));
}

TEST(TopologyOracle, SameForAnyThreads) {
  Scene scene = sphere_scene(120, 160);                                             // more than one chunk of everything
  for (int i = 0; i < 3000; ++i) add_cube(scene, vec3(i % 50, i / 50, 2 + i % 2));  // many touch
  scene = with_own_vertices(scene);
  std::mt19937 random(7);
  std::shuffle(scene.triangle_positions.begin(), scene.triangle_positions.end(), random);
  const Topology one = topology_of(scene, 1);
  EXPECT_GT(one.components.size(), 1u);
  EXPECT_GT(one.non_manifold_edges, 0u);
  for (int threads : {2, 3, 8}) {
    SCOPED_TRACE(threads);
    for (int repeat = 0; repeat < 3; ++repeat) expect_same(topology_of(scene, threads), one);
  }
}

}  // namespace
}  // namespace hybridrt
