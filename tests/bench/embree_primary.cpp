#include "tests/bench/embree_primary.h"

#include <algorithm>
#include <limits>

#include "tests/bench/embree_scene.h"

namespace hybridrt {
namespace {

constexpr int kTileWidth_px = 64, kTileHeight_px = 32;

template <int kRays>
struct Packet;
template <>
struct Packet<4> {
  using Type = RTCRayHit4;
  static constexpr int kWidth = 2, kHeight = 2;
  static constexpr auto kIntersect = rtcIntersect4;
};
template <>
struct Packet<8> {
  using Type = RTCRayHit8;
  static constexpr int kWidth = 4, kHeight = 2;
  static constexpr auto kIntersect = rtcIntersect8;
};
template <>
struct Packet<16> {
  using Type = RTCRayHit16;
  static constexpr int kWidth = 4, kHeight = 4;
  static constexpr auto kIntersect = rtcIntersect16;
};

/// The directions of a view in single precision; Embree needs no unit ones.
struct Rays {
  vec3 eye, first, step_x, step_y;
  explicit Rays(const View& view)
      : eye(view.eye), first(view.pixel_dir(0, 0)), step_x(view.ray_step_x()), step_y(view.ray_step_y()) {}
};

template <int kRays>
void find_in_tile(RTCScene scene, const View& view, const Rays& rays, int x_begin, int y_begin,
                  std::span<uint32_t> ids) {
  using P = Packet<kRays>;
  alignas(64) typename P::Type packet;
  alignas(64) int valid[kRays];
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (int y0 = y_begin; y0 < std::min(y_begin + kTileHeight_px, view.height_px); y0 += P::kHeight)
    for (int x0 = x_begin; x0 < std::min(x_begin + kTileWidth_px, view.width_px); x0 += P::kWidth) {
      for (int lane = 0; lane < kRays; ++lane) {
        const int px = x0 + lane % P::kWidth, py = y0 + lane / P::kWidth;
        const float x = static_cast<float>(px), y = static_cast<float>(py);
        valid[lane] = px < view.width_px && py < view.height_px ? -1 : 0;
        packet.ray.org_x[lane] = rays.eye.x, packet.ray.org_y[lane] = rays.eye.y, packet.ray.org_z[lane] = rays.eye.z;
        packet.ray.dir_x[lane] = rays.first.x + rays.step_x.x * x + rays.step_y.x * y;
        packet.ray.dir_y[lane] = rays.first.y + rays.step_x.y * x + rays.step_y.y * y;
        packet.ray.dir_z[lane] = rays.first.z + rays.step_x.z * x + rays.step_y.z * y;
        packet.ray.tnear[lane] = 0, packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
        packet.ray.mask[lane] = ~0u, packet.ray.flags[lane] = 0, packet.ray.time[lane] = 0, packet.ray.id[lane] = 0;
        packet.hit.geomID[lane] = packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        packet.hit.primID[lane] = kNoTriangle;
      }
      P::kIntersect(valid, scene, &context, &packet);
      for (int lane = 0; lane < kRays; ++lane)
        if (valid[lane])
          ids[static_cast<size_t>(y0 + lane / P::kWidth) * view.width_px + x0 + lane % P::kWidth] =
              packet.hit.primID[lane];
    }
}

void find_in_tile_by_streams(RTCScene scene, const View& view, const Rays& rays, int x_begin, int y_begin,
                             std::span<uint32_t> ids) {
  constexpr int kWidth = 16, kHeight = 16, kRays = kWidth * kHeight;
  alignas(64) static thread_local RTCRayHit stream[kRays];
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (int y0 = y_begin; y0 < std::min(y_begin + kTileHeight_px, view.height_px); y0 += kHeight)
    for (int x0 = x_begin; x0 < std::min(x_begin + kTileWidth_px, view.width_px); x0 += kWidth) {
      const int width = std::min(kWidth, view.width_px - x0), height = std::min(kHeight, view.height_px - y0);
      int count = 0;
      for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
          const float x = static_cast<float>(x0 + i), y = static_cast<float>(y0 + j);
          const vec3 dir = rays.first + rays.step_x * x + rays.step_y * y;
          RTCRay& ray = stream[count].ray;
          ray = {};
          ray.org_x = rays.eye.x, ray.org_y = rays.eye.y, ray.org_z = rays.eye.z;
          ray.dir_x = dir.x, ray.dir_y = dir.y, ray.dir_z = dir.z;
          ray.tfar = std::numeric_limits<float>::infinity(), ray.mask = ~0u;
          stream[count].hit.geomID = stream[count].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
          stream[count++].hit.primID = kNoTriangle;
        }
      rtcIntersect1M(scene, &context, stream, static_cast<unsigned>(count), sizeof(RTCRayHit));
      for (int k = 0; k < count; ++k)
        ids[static_cast<size_t>(y0 + k / width) * view.width_px + x0 + k % width] = stream[k].hit.primID;
    }
}

}  // namespace

EmbreePrimary::EmbreePrimary(const Scene& scene, int threads, bool robust)
    : scene_(std::make_unique<EmbreeScene>(scene, threads, robust)) {}

EmbreePrimary::~EmbreePrimary() = default;

void EmbreePrimary::find(const View& view, int packet, ThreadPool& pool, std::span<uint32_t> ids) const {
  const int tiles_x = (view.width_px + kTileWidth_px - 1) / kTileWidth_px;
  const int tiles_y = (view.height_px + kTileHeight_px - 1) / kTileHeight_px;
  const Rays rays(view);
  pool.run(static_cast<size_t>(tiles_x) * tiles_y, [&](size_t tile, int) {
    const int x = static_cast<int>(tile) % tiles_x * kTileWidth_px,
              y = static_cast<int>(tile) / tiles_x * kTileHeight_px;
    switch (packet) {
      case 4: return find_in_tile<4>(scene_->get(), view, rays, x, y, ids);
      case 8: return find_in_tile<8>(scene_->get(), view, rays, x, y, ids);
      case 16: return find_in_tile<16>(scene_->get(), view, rays, x, y, ids);
      default: return find_in_tile_by_streams(scene_->get(), view, rays, x, y, ids);
    }
  });
}

}  // namespace hybridrt
