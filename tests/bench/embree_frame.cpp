#include "tests/bench/embree_frame.h"

#include "core/trace/hit_shading.h"
#include "core/trace/ray_generations.h"
#include "core/trace/scatter.h"
#include "core/trace/texture_lookup.h"
#include "tests/bench/embree_scene.h"

namespace hybridrt {
namespace {

constexpr int kTile_px = 32, kBlock_px = 4, kPacket = kBlock_px * kBlock_px;

template <typename Packet>
void set_ray(Packet& packet, int lane, const vec3& origin, const vec3& dir) {
  packet.org_x[lane] = origin.x, packet.org_y[lane] = origin.y, packet.org_z[lane] = origin.z;
  packet.dir_x[lane] = dir.x, packet.dir_y[lane] = dir.y, packet.dir_z[lane] = dir.z;
  packet.tnear[lane] = 0, packet.tfar[lane] = std::numeric_limits<float>::infinity();
  packet.time[lane] = 0, packet.mask[lane] = 0xFFFFFFFFu, packet.id[lane] = packet.flags[lane] = 0;
}

void set_ray(RTCRay& ray, const vec3& origin, const vec3& dir) {
  ray = {};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = dir.x, ray.dir_y = dir.y, ray.dir_z = dir.z;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = 0xFFFFFFFFu;
}

/// One thread's work on a frame.
class Painter {
 public:
  Painter(const TraceJob& job, RTCScene scene) : job_(job), scene_(scene), to_light_(job.lights.at(0).light.toward) {
    rtcInitIntersectContext(&coherent_);
    coherent_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcInitIntersectContext(&incoherent_);
  }

  void block(int x0, int y0, std::span<vec4> picture) {
    const View& view = job_.view;
    alignas(64) int valid[kPacket];
    RTCRayHit16 primary;
    vec3 dirs[kPacket];
    for (int lane = 0; lane < kPacket; ++lane) {
      const int x = x0 + lane % kBlock_px, y = y0 + lane / kBlock_px;
      valid[lane] = x < view.width_px && y < view.height_px ? -1 : 0;
      dirs[lane] = vec3(glm::normalize(view.pixel_dir(x, y)));
      set_ray(primary.ray, lane, vec3(view.eye), dirs[lane]);
      primary.hit.geomID[lane] = primary.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, scene_, &coherent_, &primary);

    // All of the packet's hits are worked on at once.
    hits_.count = 0;
    int hit_of[kPacket];
    for (int lane = 0; lane < kPacket; ++lane) {
      hit_of[lane] = -1;
      if (!valid[lane] || primary.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
      const int i = hit_of[lane] = hits_.count++;
      hits_.triangle[i] = primary.hit.primID[lane];
      hits_.u[i] = primary.hit.u[lane], hits_.v[i] = primary.hit.v[lane];
      for (int k = 0; k < 3; ++k) hits_.dir[k][i] = dirs[lane][k];
      hits_.distance[i] = primary.ray.tfar[lane];
      if (job_.scene.textures)
        hits_.solid_angle[i] =
            static_cast<float>(view.sample_solid_angle(x0 + lane % kBlock_px, y0 + lane / kBlock_px));
    }
    find_surfaces(job_.scene, hits_);
    leave_toward(hits_, to_light_, shadow_origins_);

    alignas(64) int asks[kPacket];
    RTCRay16 shadow;
    for (int i = 0; i < kPacket; ++i) {
      asks[i] = i < hits_.count && job_.shadows && shadow_origins_.facing[i] ? -1 : 0;
      set_ray(shadow, i, at(shadow_origins_.origin, i), to_light_);
      if (!asks[i]) shadow.tfar[i] = -1;  // an empty range: narrow vectors look at that
    }
    rtcOccluded16(asks, scene_, &coherent_, &shadow);
    uint8_t lit[kPacket];
    for (int i = 0; i < hits_.count; ++i) lit[i] = shadow_origins_.facing[i] && !(asks[i] && shadow.tfar[i] < 0);
    shade_hits(job_, hits_, lit, colors_);
    if (job_.reflection_depth > 0) scatter_all(job_.scene, hits_, scattered_);

    for (int lane = 0; lane < kPacket; ++lane) {
      if (!valid[lane]) continue;
      const int i = hit_of[lane], x = x0 + lane % kBlock_px, y = y0 + lane / kBlock_px;
      const vec3 color = i < 0 ? job_.background : at(colors_, i) + scattered_from(i);
      picture[static_cast<size_t>(y) * view.width_px + x] = vec4(color, i >= 0);
    }
  }

 private:
  /// Where a ray met a triangle.
  struct Met {
    uint32_t triangle;
    float u, v;
    vec3 dir;
    float path;  ///< from the eye
  };

  SurfaceColors<float> paint_of(const Met& met, const Material& m) const {
    return m.texture_maps == 0
               ? plain_colors(job_.scene, met.triangle, met.u, met.v)
               : textured_colors(job_.scene, met.triangle, met.u, met.v, met.dir, solid_angle_, met.path);
  }

  vec3 shade(const Met& met, const Surface<float>& surface, bool lit) const {
    const Material& m = job_.scene.materials[surface.material];
    const SurfaceColors<float> paint = paint_of(met, m);
    const vec3 unlit =
        phong_unlit(paint.kd, paint.ke, m.opacity, ambient_at(job_.ambient.color, job_.ambient.slope, surface.normal));
    return lit ? unlit + phong_light(paint.kd, paint.ks, m.ns, m.opacity, surface.normal, -met.dir, to_light_,
                                     job_.lights[0].light.color)
               : unlit;
  }

  static vec3 at(const float (&values)[3][HitSurfaces<float>::kRoom], int i) {
    return {values[0][i], values[1][i], values[2][i]};
  }

  /// What a hit of the packet reflects and refracts.
  vec3 scattered_from(int i) {
    const Material& material = job_.scene.materials[hits_.material[i]];
    if (job_.reflection_depth == 0 || (!material.reflective() && !material.transmissive())) return vec3(0);
    solid_angle_ = hits_.solid_angle[i];
    const auto follow_one = [&](const LeavingRays<float>& rays) {
      return follow({at(rays.origin, i), at(rays.dir, i)}, at(rays.weight, i), hits_.distance[i], 1);
    };
    return follow_one(scattered_.reflected) + follow_one(scattered_.refracted);
  }

  vec3 scattered(const Met& met, const Surface<float>& surface, const vec3& weight, int generation) {
    const Material& material = job_.scene.materials[surface.material];
    if (generation >= job_.reflection_depth || (!material.reflective() && !material.transmissive())) return vec3(0);
    const vec3 reflect = material.texture_maps == 0 ? material.reflect : paint_of(met, material).reflect;
    const Scattered<float> out = scatter(material, reflect, surface, met.dir);
    return follow(leave(surface, out.reflected_dir), weight * out.reflected_weight, met.path, generation + 1) +
           follow(leave(surface, out.refracted_dir, false), weight * out.refracted_weight, met.path, generation + 1);
  }

  /// `path`: from the eye to the ray's origin.
  vec3 follow(const Ray<float>& ray, const vec3& weight, float path, int generation) {
    if (std::max({weight.x, weight.y, weight.z}) < kSmallestWeight) return vec3(0);
    RTCRayHit query;
    set_ray(query.ray, ray.origin, ray.dir);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &incoherent_, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return weight * job_.background;
    const Met met{query.hit.primID, query.hit.u, query.hit.v, ray.dir, path + query.ray.tfar};
    const Surface<float> surface = surface_at(job_.scene, met.triangle, met.u, met.v, ray.dir);
    bool lit = glm::dot(surface.side, to_light_) > 0;
    if (lit && job_.shadows) {
      RTCRay shadow;
      set_ray(shadow, leave(surface, to_light_).origin, to_light_);
      rtcOccluded1(scene_, &incoherent_, &shadow);
      lit = shadow.tfar >= 0;
    }
    return weight * shade(met, surface, lit) + scattered(met, surface, weight, generation);
  }

  const TraceJob& job_;
  RTCScene scene_;
  vec3 to_light_;
  float solid_angle_ = 0;  ///< of the pixel at hand
  HitSurfaces<float> hits_{};
  ShadowOrigins<float> shadow_origins_{};
  float colors_[3][HitSurfaces<float>::kRoom];
  ScatteredFromHits<float> scattered_;
  RTCIntersectContext coherent_, incoherent_;
};

}  // namespace

EmbreeFrame::EmbreeFrame(const Scene& scene, int threads)
    : scene_(std::make_unique<EmbreeScene>(scene, threads, /*robust=*/false)) {}

EmbreeFrame::~EmbreeFrame() = default;

void EmbreeFrame::render(const TraceJob& job, ThreadPool& pool, std::span<vec4> picture) const {
  const int tiles_x = (job.view.width_px + kTile_px - 1) / kTile_px;
  const int tiles_y = (job.view.height_px + kTile_px - 1) / kTile_px;
  pool.run(static_cast<size_t>(tiles_x) * tiles_y, [&](size_t tile, int) {
    Painter painter(job, scene_->get());
    const int x0 = static_cast<int>(tile) % tiles_x * kTile_px, y0 = static_cast<int>(tile) / tiles_x * kTile_px;
    for (int y = y0; y < std::min(y0 + kTile_px, job.view.height_px); y += kBlock_px)
      for (int x = x0; x < std::min(x0 + kTile_px, job.view.width_px); x += kBlock_px) painter.block(x, y, picture);
  });
}

}  // namespace hybridrt
