#include "core/trace/ray_generations.h"

#include "core/base/check.h"
#include "core/base/timing.h"
#include "core/trace/prefetch.h"
#include "core/trace/primary_surface.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

constexpr size_t kBatchRays = 4096;

template <typename Real>
Real largest_part(const Vec3<Real>& v) {
  return std::max({v.x, v.y, v.z});
}

}  // namespace

template <typename Real>
RayGenerations<Real>::RayGenerations(const TraceJob& job, const RayCaster<Real>* caster)
    : job_(job),
      caster_(caster),
      ambient_(job.ambient.color),
      ambient_slope_(job.ambient.slope),
      background_(job.background),
      asks_buffers_(job.has_buffers()),
      shadow_queues_(job.lights.size()) {
  HRT_CHECK(job.lights.size() <= HRT_MAX_LIGHTS);
  for (const TracedLight& traced : job.lights) {
    to_light_.emplace_back(traced.light.toward);
    light_color_.emplace_back(traced.light.color);
  }
}

template <typename Real>
void RayGenerations<Real>::push(const Ray<Real>& ray, const Tag& tag) {
  rays_.push_back(ray);
  tags_.push_back(tag);
}

template <typename Real>
void RayGenerations<Real>::add_primary(uint32_t pixel, int x, int y) {
  Ray<Real> ray;
  ray.origin = Vec3<Real>(job_.view.eye);
  const dvec3 dir = glm::normalize(job_.view.pixel_dir(x, y));
  ray.dir = Vec3<Real>(dir);
  if (asks_buffers_) {
    primary_dirs_.resize(std::max<size_t>(primary_dirs_.size(), pixel + 1));
    primary_dirs_[pixel] = dir;
  }
  if (job_.scene.textures) set_solid_angle(pixel, static_cast<Real>(job_.view.sample_solid_angle(x, y)));
  push(ray, {Vec3<Real>(1), pixel, 0});
}

template <typename Real>
void RayGenerations<Real>::set_solid_angle(uint32_t pixel, Real solid_angle) {
  solid_angles_.resize(std::max<size_t>(solid_angles_.size(), pixel + 1));
  solid_angles_[pixel] = solid_angle;
}

template <typename Real>
void RayGenerations<Real>::add_scattered(uint32_t pixel, const Surface<Real>& surface, const Vec3<Real>& reflect,
                                         const Vec3<Real>& dir, Real distance, Real solid_angle, TraceStats& stats) {
  if (job_.scene.textures) set_solid_angle(pixel, solid_angle);
  scatter_on({Vec3<Real>(1), pixel, 0}, surface, reflect, dir, distance, stats);
}

/// `path`: the distance from the eye to the surface.
template <typename Real>
void RayGenerations<Real>::scatter_on(const Tag& from, const Surface<Real>& surface, const Vec3<Real>& reflect,
                                      const Vec3<Real>& dir, Real path, TraceStats& stats) {
  const Material& material = job_.scene.materials[surface.material];
  if (from.generation == 0) {
    stats.pixels_reflective += material.reflective();
    stats.pixels_refractive += material.transmissive();
  }
  if (from.generation >= job_.reflection_depth || (!material.reflective() && !material.transmissive())) return;

  const Scattered<Real> out = scatter(material, reflect, surface, dir);
  const Vec3<Real> reflected = from.weight * out.reflected_weight, refracted = from.weight * out.refracted_weight;
  if (largest_part(reflected) >= Real(kSmallestWeight)) {
    push(leave(surface, out.reflected_dir), {reflected, from.pixel, from.generation + 1, from.refracted, path});
    ++stats.reflection_rays;
  }
  if (largest_part(refracted) >= Real(kSmallestWeight)) {
    push(leave(surface, out.refracted_dir, /*toward=*/false), {refracted, from.pixel, from.generation + 1, true, path});
    ++stats.refraction_rays;
  }
}

template <typename Real>
void RayGenerations<Real>::take_batch() {
  const size_t first = rays_.size() - std::min(rays_.size(), kBatchRays);
  batch_rays_.assign(rays_.begin() + first, rays_.end());
  batch_tags_.assign(tags_.begin() + first, tags_.end());
  rays_.resize(first);
  tags_.resize(first);
}

/// Fills surfaces_, of the hits. Few at a time, so that what is fetched stays in the cache until it is read.
template <typename Real>
void RayGenerations<Real>::find_surfaces() {
  constexpr size_t kAtOnce = 64;
  surfaces_.resize(hits_.size());
  for (size_t first = 0; first < hits_.size(); first += kAtOnce) {
    const size_t end = std::min(first + kAtOnce, hits_.size());
    const auto for_each_hit = [&](const auto& body) {
      for (size_t i = first; i < end; ++i)
        if (hits_[i].found()) body(i, hits_[i].triangle);
    };
    for_each_hit([&](size_t, uint32_t triangle) { prefetch_numbers(job_.scene, triangle); });
    for_each_hit([&](size_t, uint32_t triangle) { prefetch_corners(job_.scene, triangle); });
    for_each_hit([&](size_t i, uint32_t triangle) {
      surfaces_[i] = surface_at(job_.scene, triangle, hits_[i].u, hits_[i].v, batch_rays_[i].dir);
    });
  }
}

/// Queues a shadow ray to every light that the hit's side faces; lights without shadows arrive without one.
template <typename Real>
void RayGenerations<Real>::queue_shadow_rays(size_t i) {
  const Tag& tag = batch_tags_[i];
  const Surface<Real>& surface = surfaces_[i];
  const auto ask_buffer = [&](size_t l, const ShadowQuery& query) {
    lit_[i] |= 1u << l;
    shadow_queues_[l].owners.push_back(i);
    shadow_queues_[l].queries.push_back(query);
    shadow_queues_[l].queries.back().anywhere = job_.eye_enclosed || tag.refracted;
  };
  const bool as_seen = asks_buffers_ && tag.generation == 0;
  if (as_seen)
    for_each_facing_light(job_.scene, hits_[i].triangle, job_.view.eye, primary_dirs_[tag.pixel], job_.lights,
                          [&](size_t l, const ShadowQuery& query) {
                            if (job_.casts_shadow(l)) ask_buffer(l, query);
                          });
  for (size_t l = 0; l < to_light_.size(); ++l) {
    const bool asks = job_.casts_shadow(l);
    if ((as_seen && asks) || glm::dot(surface.side, to_light_[l]) <= 0) continue;  // the unlit side needs no ray
    if (asks && asks_buffers_) {
      ask_buffer(l, {dvec3(leave(surface, to_light_[l]).origin), hits_[i].triangle, surface.from_outside});
      continue;
    }
    lit_[i] |= 1u << l;
    if (!asks) continue;
    shadow_queues_[l].owners.push_back(i);
    shadow_queues_[l].rays.push_back(leave(surface, to_light_[l]));
  }
}

/// Fills lit_: the lights that reach the hits of the batch.
template <typename Real>
void RayGenerations<Real>::ask_shadow_rays(TraceStats& stats) {
  for (ShadowQueue<Real>& queue : shadow_queues_) queue.clear();
  lit_.assign(hits_.size(), 0);
  for (size_t i = 0; i < hits_.size(); ++i)
    if (hits_[i].found()) queue_shadow_rays(i);
  for (size_t l = 0; l < shadow_queues_.size(); ++l) {
    ShadowQueue<Real>& queue = shadow_queues_[l];
    queue.answer(job_.lights[l], caster_);
    stats.shadow_rays += static_cast<int64_t>(queue.owners.size());
    for (size_t k = 0; k < queue.owners.size(); ++k) {
      const size_t i = queue.owners[k];
      stats.primary_shadow_rays += batch_tags_[i].generation == 0;
      if (queue.occluded[k]) lit_[i] &= ~(1u << l);
    }
  }
}

template <typename Real>
SurfaceColors<Real> RayGenerations<Real>::colors_of(size_t i) const {
  const Material& material = job_.scene.materials[surfaces_[i].material];
  if (material.texture_maps == 0) return plain_colors(job_.scene, hits_[i].triangle, hits_[i].u, hits_[i].v);
  return textured_colors(job_.scene, hits_[i].triangle, hits_[i].u, hits_[i].v, batch_rays_[i].dir,
                         solid_angles_[batch_tags_[i].pixel], batch_tags_[i].path + hits_[i].t);
}

/// The surface's own light, without reflected and refracted rays.
template <typename Real>
Vec3<Real> RayGenerations<Real>::color_of(size_t i, const SurfaceColors<Real>& paint) const {
  const Surface<Real>& surface = surfaces_[i];
  const Material& m = job_.scene.materials[surface.material];
  Vec3<Real> color =
      phong_unlit(paint.kd, paint.ke, Real(m.opacity), ambient_at(ambient_, ambient_slope_, surface.normal));
  for (size_t l = 0; l < to_light_.size(); ++l)
    if (lit_[i] >> l & 1)
      color += phong_light(paint.kd, paint.ks, Real(m.ns), Real(m.opacity), surface.normal, -batch_rays_[i].dir,
                           to_light_[l], light_color_[l]);
  return color;
}

template <typename Real>
void RayGenerations<Real>::run(std::span<Vec3<Real>> colors, std::span<PrimaryHit> primary_hits, TraceStats& stats) {
  while (!rays_.empty()) {
    const double started_ms = thread_cpu_ms();
    take_batch();
    const bool primary = batch_tags_.front().generation == 0;
    hits_.resize(batch_rays_.size());
    caster_->closest_hits(batch_rays_, hits_);
    find_surfaces();

    const double before_shadows_ms = thread_cpu_ms();
    ask_shadow_rays(stats);
    if (primary) stats.shadow_cpu_ms += thread_cpu_ms() - before_shadows_ms;

    for (size_t i = 0; i < hits_.size(); ++i) {
      const Tag& tag = batch_tags_[i];
      if (!hits_[i].found()) {
        colors[tag.pixel] += tag.weight * background_;
        continue;
      }
      if (tag.generation == 0) {
        primary_hits[tag.pixel] = {hits_[i].triangle, lit_[i]};
        ++stats.pixels_hit;
      }
      const Surface<Real>& surface = surfaces_[i];
      const SurfaceColors<Real> paint = colors_of(i);
      colors[tag.pixel] += tag.weight * color_of(i, paint);
      scatter_on(tag, surface, paint.reflect, batch_rays_[i].dir, tag.path + hits_[i].t, stats);
    }
    if (!primary) stats.secondary_cpu_ms += thread_cpu_ms() - started_ms;
  }
}

template class RayGenerations<float>;
template class RayGenerations<double>;

}  // namespace hybridrt
