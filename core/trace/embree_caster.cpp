#include "core/trace/embree_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/start_thread.h"
#include "core/trace/coincident.h"
#include "core/trace/embree_handles.h"
#include "core/trace/holes.h"
#include "core/trace/triangle.h"

namespace hybridrt {
namespace {

class EmbreeCaster final : public RayCaster<float> {
 public:
  EmbreeCaster(const Scene& scene, int threads, EmbreeRays going) : going_(going), coincident_(find_coincident(scene)) {
    HRT_CHECK(threads >= 1);
    if (scene.has_holes()) holes_ = scene.textures;
    require_threads(threads + 1);  // its own: it aborts where they cannot be started
    device_.reset(rtcNewDevice(fmt::format("threads={}", threads).c_str()));
    if (!device_) throw_on_embree_error(nullptr, "starting");
    scene_.reset(rtcNewScene(device_.get()));
    throw_on_embree_error(device_.get(), "creating a scene");
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
    attach_triangles(scene);
    rtcCommitScene(scene_.get());
    throw_on_embree_error(device_.get(), "building its tree");
  }

  void closest_hits(std::span<const Ray<float>> rays, std::span<Hit<float>> hits) const override {
    HRT_CHECK_EQ(rays.size(), hits.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (going_ == EmbreeRays::packets) return closest_hits_in_packets(rays, hits, context);
    for (size_t i = 0; i < rays.size(); ++i) {
      hits[i] = {};
      RTCRayHit query;
      if (!fill(rays[i], query.ray)) continue;
      query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_.get(), &context, &query);
      if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID)
        hits[i] = hit_of(query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID, rays[i].dir);
    }
  }

  void any_hits(std::span<const Ray<float>> rays, std::span<uint8_t> occluded) const override {
    HRT_CHECK_EQ(rays.size(), occluded.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (going_ == EmbreeRays::packets) return any_hits_in_packets(rays, occluded, context);
    for (size_t i = 0; i < rays.size(); ++i) {
      occluded[i] = 0;
      RTCRay query;
      if (!fill(rays[i], query)) continue;
      rtcOccluded1(scene_.get(), &context, &query);
      occluded[i] = query.tfar < 0;  // Embree's way of saying yes
    }
  }

 private:
  static constexpr size_t kPacket = 16;

  void closest_hits_in_packets(std::span<const Ray<float>> rays, std::span<Hit<float>> hits,
                               RTCIntersectContext& context) const {
    for (size_t first = 0; first < rays.size(); first += kPacket) {
      alignas(64) int valid[kPacket];
      RTCRayHit16 packet;
      const size_t count = fill_packet(rays.subspan(first), valid, packet.ray);
      context.flags = flags_for(rays.subspan(first, count));
      std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
      std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
      rtcIntersect16(valid, scene_.get(), &context, &packet);
      for (size_t i = 0; i < count; ++i)
        hits[first + i] = valid[i] && packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID
                              ? hit_of(packet.ray.tfar[i], packet.hit.u[i], packet.hit.v[i], packet.hit.primID[i],
                                       rays[first + i].dir)
                              : Hit<float>{};
    }
  }

  void any_hits_in_packets(std::span<const Ray<float>> rays, std::span<uint8_t> occluded,
                           RTCIntersectContext& context) const {
    for (size_t first = 0; first < rays.size(); first += kPacket) {
      alignas(64) int valid[kPacket];
      RTCRay16 packet;
      const size_t count = fill_packet(rays.subspan(first), valid, packet);
      context.flags = flags_for(rays.subspan(first, count));
      rtcOccluded16(valid, scene_.get(), &context, &packet);
      for (size_t i = 0; i < count; ++i) occluded[first + i] = valid[i] && packet.tfar[i] < 0;
    }
  }

  /// Rays that go nearly the same way pass through the tree together, others one by one once they part: that saves rays
  /// off curved mirrors a tenth to a quarter, and would cost primary rays half as much again (docs/results/trace.md).
  static RTCIntersectContextFlags flags_for(std::span<const Ray<float>> packet) {
    constexpr float kLeastCosine = 0.95f;
    const auto turns_away = [&](const Ray<float>& ray) { return glm::dot(ray.dir, packet[0].dir) < kLeastCosine; };
    return std::ranges::any_of(packet, turns_away) ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT
                                                   : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }

  /// The first rays, as many as fit; returns how many. Lanes without one have an empty range of t as well: where its
  /// vectors are narrower than a packet, Embree looks at that and not at `valid`.
  static size_t fill_packet(std::span<const Ray<float>> rays, int* valid, RTCRay16& packet) {
    const size_t count = std::min(rays.size(), kPacket);
    for (size_t i = 0; i < kPacket; ++i) {
      RTCRay ray;
      valid[i] = i < count && fill(rays[i], ray) ? -1 : 0;
      if (!valid[i]) {
        ray = {};
        ray.tnear = 1;
      }
      packet.org_x[i] = ray.org_x, packet.org_y[i] = ray.org_y, packet.org_z[i] = ray.org_z;
      packet.dir_x[i] = ray.dir_x, packet.dir_y[i] = ray.dir_y, packet.dir_z[i] = ray.dir_z;
      packet.tnear[i] = ray.tnear, packet.tfar[i] = ray.tfar;
      packet.time[i] = ray.time, packet.mask[i] = ray.mask, packet.id[i] = ray.id, packet.flags[i] = ray.flags;
    }
    return count;
  }

  void attach_triangles(const Scene& scene) {
    size_t left_out = 0;
    for_each_triangle(scene, [&](uint32_t, bool is_kept) { left_out += !is_kept; });
    const size_t count = scene.triangle_count() - left_out;
    if (count == 0) return;
    if (left_out > 0) {
      kept_.reserve(count), triangle_of_primitive_.reserve(count);
      for_each_triangle(scene, [&](uint32_t i, bool is_kept) {
        if (is_kept) kept_.push_back(scene.triangle_positions[i]), triangle_of_primitive_.push_back(i);
      });
    }
    const EmbreeHandle<RTCGeometry> geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    lend_triangles(device_.get(), geometry.get(), scene.positions, left_out > 0 ? kept_ : scene.triangle_positions);
    if (holes_) {
      rtcSetGeometryUserData(geometry.get(), this);
      rtcSetGeometryIntersectFilterFunction(geometry.get(), pass_holes);
      rtcSetGeometryOccludedFilterFunction(geometry.get(), pass_holes);
    }
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene_.get(), geometry.get());
    throw_on_embree_error(device_.get(), "taking the triangles");
  }

  /// Calls body(triangle, is_kept) for each of the scene's, in order.
  template <typename Body>
  void for_each_triangle(const Scene& scene, const Body& body) const {
    HiddenTriangles hidden(coincident_);
    for (uint32_t i = 0; i < scene.triangle_count(); ++i)
      body(i, !hidden.holds(i) && !is_degenerate(scene.vertex(i, 0), scene.vertex(i, 1), scene.vertex(i, 2)));
  }

  /// Embree's filter function: rejects hits in holes.
  static void pass_holes(const RTCFilterFunctionNArguments* args) {
    const auto& caster = *static_cast<const EmbreeCaster*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
      if (args->valid[i] == 0) continue;
      const uint32_t triangle = caster.scene_triangle(RTCHitN_primID(args->hit, args->N, i));
      const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
      if (is_hole(*caster.holes_, triangle, u, v)) args->valid[i] = 0;
    }
  }

  /// False for rays that cannot hit anything. Embree's range of t is closed, ours is open.
  static bool fill(const Ray<float>& ray, RTCRay& query) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    if (!is_traceable(ray.origin, ray.dir)) return false;
    query.org_x = ray.origin.x, query.org_y = ray.origin.y, query.org_z = ray.origin.z;
    query.dir_x = ray.dir.x, query.dir_y = ray.dir.y, query.dir_z = ray.dir.z;
    query.tnear = ray.t_min == 0 ? std::numeric_limits<float>::denorm_min() : std::nextafter(ray.t_min, kInfinity);
    query.tfar = ray.t_max == kInfinity ? kInfinity : std::nextafter(ray.t_max, -kInfinity);
    query.time = 0;
    query.mask = 0xFFFFFFFFu;
    query.id = query.flags = 0;
    return query.tnear <= query.tfar;
  }

  uint32_t scene_triangle(uint32_t primitive) const {
    return triangle_of_primitive_.empty() ? primitive : triangle_of_primitive_[primitive];
  }

  /// Embree answers ties at random; this is NearestHit's answer.
  Hit<float> hit_of(float t, float u, float v, uint32_t primitive, const vec3& dir) const {
    const TriangleAt shown = winner_of_tie(coincident_, holes_.get(), {scene_triangle(primitive), u, v}, dir);
    return {t, shown.u, shown.v, shown.triangle};
  }

  const EmbreeRays going_;
  CoincidentTriangles coincident_;
  std::vector<uvec3> kept_;  ///< Embree's triangles; empty: all of the scene's
  EmbreeHandle<RTCDevice> device_;
  EmbreeHandle<RTCScene> scene_;
  std::vector<uint32_t> triangle_of_primitive_;  ///< empty: the same numbers
  std::shared_ptr<const Textures> holes_;        ///< null where no triangle has any
};

}  // namespace

std::unique_ptr<RayCaster<float>> make_embree_caster(const Scene& scene, int threads, EmbreeRays going) {
  return std::make_unique<EmbreeCaster>(scene, threads, going);
}

}  // namespace hybridrt
