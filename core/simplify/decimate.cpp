#include "core/simplify/decimate.h"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModAspectRatioT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <OpenMesh/Tools/Decimater/Observer.hh>
#include <algorithm>
#include <limits>

#include "core/base/check.h"
#include "core/mesh/weld.h"
#include "core/simplify/decimation_modules.h"

namespace hybridrt {
namespace {

using namespace decimation;

constexpr double kMostTurn_deg = 60;   // of a triangle by one collapse
constexpr double kLargestAspect = 20;  // of a new triangle, unless worse ones vanish
constexpr size_t kCollapsesBetweenAsking = 4096;

class StopWatcher final : public OpenMesh::Decimater::Observer {
 public:
  explicit StopWatcher(const std::function<bool()>& stop) : Observer(kCollapsesBetweenAsking), stop_(stop) {}
  void notify(size_t) override {}
  bool abort() const override { return stop_ && stop_(); }

 private:
  const std::function<bool()>& stop_;
};

/// The middles of edges are samples, as is each vertex that vanishes.
std::vector<std::vector<Sample>> samples_of_faces(SurfaceMesh& surface, std::span<const float> bounds) {
  std::vector<std::vector<Sample>> samples(surface.triangle_of_face.size());
  const auto bound_of = [&](Mesh::FaceHandle face) {
    return face.is_valid()
               ? surface.mesh_from_scene * bounds[surface.triangle_of_face[static_cast<size_t>(face.idx())].from]
               : std::numeric_limits<double>::infinity();
  };
  for (const auto edge : surface.mesh.edges()) {
    const Mesh::FaceHandle one = edge.h0().face(), other = edge.h1().face();
    samples[static_cast<size_t>((one.is_valid() ? one : other).idx())].push_back(
        {to_dvec3(surface.mesh.calc_edge_midpoint(edge)), std::min(bound_of(one), bound_of(other))});
  }
  return samples;
}

std::vector<double> bounds_of_vertices(const SurfaceMesh& surface, const Fans& fans, std::span<const float> bounds) {
  std::vector<double> of_vertex(fans.vertex_of_fan.size(), std::numeric_limits<double>::infinity());
  for (Corner corner = 0; corner < fans.fan_of_corner.size(); ++corner)
    if (const uint32_t fan = fans.fan_of_corner[corner]; fan != kNoFan)
      of_vertex[fan] = std::min(of_vertex[fan], surface.mesh_from_scene * bounds[corner / 3]);
  return of_vertex;
}

void collapse_edges(SurfaceMesh& surface, const Scene& scene, const Fans& fans, std::span<const float> bounds,
                    const std::function<bool()>& stop) {
  // The cheapest test first: the first that fails ends them.
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(surface.mesh);
  KeepCorners::Handle corners;
  OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle flipping;
  OpenMesh::Decimater::ModAspectRatioT<Mesh>::Handle aspect;
  SampledBounds::Handle sampled;
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
  decimater.add(corners);
  decimater.add(flipping);
  decimater.add(aspect);
  decimater.add(sampled);
  decimater.add(quadric);
  decimater.module(corners).set(scene, fans, surface.triangle_of_face);
  decimater.module(flipping).set_max_normal_deviation(kMostTurn_deg);
  decimater.module(aspect).set_aspect_ratio(kLargestAspect);
  decimater.module(sampled).set(samples_of_faces(surface, bounds), bounds_of_vertices(surface, fans, bounds),
                                decimater.module(quadric));
  decimater.module(quadric).unset_max_err();
  StopWatcher watcher(stop);
  decimater.set_observer(&watcher);
  HRT_CHECK(decimater.initialize());
  decimater.decimate();
}

}  // namespace

Scene decimate(const Scene& scene, const Topology& topology, std::span<const float> bounds, ThreadPool& pool,
               const std::function<bool()>& stop) {
  const std::vector<uint32_t> welded = weld_positions(scene.positions, pool);
  const Fans fans = find_fans(scene, topology, welded, bounds);
  SurfaceMesh surface = make_surface_mesh(scene, fans);
  collapse_edges(surface, scene, fans, bounds, stop);

  std::vector<CornerTriangle> triangles;
  for (uint32_t t = 0; t < scene.triangle_count(); ++t)
    if (fans.fan_of_corner[3 * t] == kNoFan) triangles.push_back(as_it_is(t));
  for (const auto face : surface.mesh.faces())  // those that are left
    triangles.push_back(surface.triangle_of_face[static_cast<size_t>(face.idx())]);
  std::sort(triangles.begin(), triangles.end(),
            [](const CornerTriangle& a, const CornerTriangle& b) { return a.from < b.from; });
  return scene_of_corners(scene, triangles);
}

}  // namespace hybridrt
