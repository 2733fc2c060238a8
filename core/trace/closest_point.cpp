#include "core/trace/closest_point.h"

#include <cmath>
#include <limits>

#include "core/base/check.h"
#include "core/mesh/triangle_distance.h"
#include "core/trace/embree_handles.h"

namespace hybridrt {
namespace {

struct Query {
  const Scene& scene;
  dvec3 point;
  ClosestPoint found;
};

/// Embree's point query function: called for triangles whose boxes are within the radius, which it may reduce.
bool look_at(RTCPointQueryFunctionArguments* args) {
  Query& query = *static_cast<Query*>(args->userPtr);
  const auto corner = [&](int k) { return dvec3(query.scene.vertex(args->primID, k)); };
  const double squared = squared_distance_to_triangle(query.point, corner(0), corner(1), corner(2));
  const double distance = std::sqrt(squared);
  if (!(distance < query.found.distance)) return false;
  query.found = {args->primID, distance};
  args->query->radius = std::nextafter(static_cast<float>(distance), std::numeric_limits<float>::infinity());
  return true;
}

}  // namespace

struct ClosestPoints::Tree {
  const Scene& scene;
  EmbreeHandle<RTCDevice> device;
  EmbreeHandle<RTCScene> tree;
};

ClosestPoints::ClosestPoints(const Scene& scene, int threads) : tree_(std::make_unique<Tree>(Tree{scene, {}, {}})) {
  HRT_CHECK(threads >= 1);
  tree_->device.reset(rtcNewDevice(fmt::format("threads={}", threads).c_str()));
  const RTCDevice device = tree_->device.get();
  if (!device) throw_on_embree_error(nullptr, "starting");
  tree_->tree.reset(rtcNewScene(device));
  throw_on_embree_error(device, "creating a scene");
  rtcSetSceneFlags(tree_->tree.get(), RTC_SCENE_FLAG_ROBUST);
  if (scene.triangle_count() > 0) {
    const EmbreeHandle<RTCGeometry> geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    lend_triangles(device, geometry.get(), scene.positions, scene.triangle_positions);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(tree_->tree.get(), geometry.get());
  }
  rtcCommitScene(tree_->tree.get());
  throw_on_embree_error(device, "building its tree");
}

ClosestPoints::~ClosestPoints() = default;

ClosestPoint ClosestPoints::nearest(const dvec3& point, double likely) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double radius : {likely, kInfinity}) {
    Query query{tree_->scene, point, {kNoTriangle, kInfinity}};
    RTCPointQuery at{};
    at.x = static_cast<float>(point.x), at.y = static_cast<float>(point.y), at.z = static_cast<float>(point.z);
    at.radius = static_cast<float>(radius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(tree_->tree.get(), &at, &context, look_at, &query);
    if (query.found.distance <= radius) return query.found;
  }
  return {};
}

}  // namespace hybridrt
