#include "core/trace/ray_generations.h"

#include "core/base/check.h"
#include "core/trace/primary_surface.h"

#include <time.h>

namespace hybridrt {
namespace {

constexpr size_t kBatchRays = 4096;

template <typename Real>
Real largest_part(const Vec3<Real>& v) {
  return std::max({v.x, v.y, v.z});
}

}  // namespace

double thread_cpu_ms() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

void TraceStats::add(const TraceStats& other) {
  pixels_hit += other.pixels_hit;
  pixels_marked += other.pixels_marked;
  pixels_reflective += other.pixels_reflective;
  pixels_refractive += other.pixels_refractive;
  shadow_rays += other.shadow_rays;
  primary_shadow_rays += other.primary_shadow_rays;
  reflection_rays += other.reflection_rays;
  refraction_rays += other.refraction_rays;
  pixels_suspect += other.pixels_suspect;
  pixels_repaired += other.pixels_repaired;
  repair_ms += other.repair_ms;
  shadow_cpu_ms += other.shadow_cpu_ms;
  secondary_cpu_ms += other.secondary_cpu_ms;
}

template <typename Real>
RayGenerations<Real>::RayGenerations(const TraceJob& job, const RayCaster<Real>* caster)
    : job_(job), caster_(caster), to_light_(job.light.toward) {}

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
  if (job_.light_buffer) {
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

/// `path`: from the eye to the surface.
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

/// Nothing where the light does not reach that side of the surface.
template <typename Real>
std::optional<ShadowQuery> RayGenerations<Real>::shadow_query(size_t i) const {
  const Tag& tag = batch_tags_[i];
  std::optional<ShadowQuery> query;
  if (tag.generation == 0)
    query = primary_shadow_query(job_.scene, hits_[i].triangle, job_.view.eye, primary_dirs_[tag.pixel],
                                 job_.light.toward);
  else if (glm::dot(surfaces_[i].side, to_light_) > 0)
    query = ShadowQuery{dvec3(leave(surfaces_[i], to_light_).origin), hits_[i].triangle, surfaces_[i].from_outside};
  if (query) query->anywhere = job_.eye_enclosed || tag.refracted;
  return query;
}

/// Fills lit_: which hits of the batch the light reaches.
template <typename Real>
void RayGenerations<Real>::ask_shadow_rays(TraceStats& stats) {
  shadow_rays_.clear();
  shadow_queries_.clear();
  shadow_owner_.clear();
  lit_.assign(hits_.size(), 0);
  for (size_t i = 0; i < hits_.size(); ++i) {
    if (!hits_[i].found()) continue;
    if (job_.shadows && job_.light_buffer) {
      const std::optional<ShadowQuery> query = shadow_query(i);
      if (!query) continue;
      shadow_queries_.push_back(*query);
    } else {
      if (glm::dot(surfaces_[i].side, to_light_) <= 0) continue;  // the unlit side needs no ray
      if (job_.shadows) shadow_rays_.push_back(leave(surfaces_[i], to_light_));
    }
    lit_[i] = 1;
    if (!job_.shadows) continue;
    shadow_owner_.push_back(static_cast<uint32_t>(i));
    stats.primary_shadow_rays += batch_tags_[i].generation == 0;
  }
  stats.shadow_rays += static_cast<int64_t>(shadow_owner_.size());
  occluded_.resize(shadow_owner_.size());
  if (job_.light_buffer)
    shadow_answers(*job_.light_buffer, shadow_queries_, occluded_);
  else
    caster_->any_hits(shadow_rays_, occluded_);
  for (size_t i = 0; i < occluded_.size(); ++i)
    if (occluded_[i]) lit_[shadow_owner_[i]] = 0;
}

template <typename Real>
SurfaceColors<Real> RayGenerations<Real>::colors_of(size_t i) const {
  const Material& material = job_.scene.materials[surfaces_[i].material];
  if (material.texture_maps == 0) return plain_colors<Real>(material);
  return textured_colors(job_.scene, hits_[i].triangle, hits_[i].u, hits_[i].v, batch_rays_[i].dir,
                         solid_angles_[batch_tags_[i].pixel], batch_tags_[i].path + hits_[i].t);
}

template <typename Real>
void RayGenerations<Real>::run(std::span<Vec3<Real>> colors, std::span<PrimaryHit> primary_hits, TraceStats& stats) {
  const Scene& scene = job_.scene;
  const Vec3<Real> light(job_.light.color), ambient(job_.ambient), background(job_.background);
  while (!rays_.empty()) {
    const double started_ms = thread_cpu_ms();
    take_batch();
    const bool primary = batch_tags_.front().generation == 0;
    hits_.resize(batch_rays_.size());
    surfaces_.resize(batch_rays_.size());
    caster_->closest_hits(batch_rays_, hits_);
    for (size_t i = 0; i < hits_.size(); ++i)
      if (hits_[i].found())
        surfaces_[i] = surface_at(scene, hits_[i].triangle, hits_[i].u, hits_[i].v, batch_rays_[i].dir);

    const double before_shadows_ms = thread_cpu_ms();
    ask_shadow_rays(stats);
    if (primary) stats.shadow_cpu_ms += thread_cpu_ms() - before_shadows_ms;

    for (size_t i = 0; i < hits_.size(); ++i) {
      const Tag& tag = batch_tags_[i];
      if (!hits_[i].found()) {
        colors[tag.pixel] += tag.weight * background;
        continue;
      }
      if (tag.generation == 0) {
        primary_hits[tag.pixel] = {hits_[i].triangle, lit_[i] != 0};
        ++stats.pixels_hit;
      }
      const Surface<Real>& surface = surfaces_[i];
      const Material& m = scene.materials[surface.material];
      const SurfaceColors<Real> paint = colors_of(i);
      const Vec3<Real>& dir = batch_rays_[i].dir;
      colors[tag.pixel] +=
          tag.weight * phong(paint.kd, paint.ks, paint.ke, Real(m.ns), Real(m.opacity), surface.normal, -dir,
                             to_light_, ambient, light, Real(lit_[i]));
      scatter_on(tag, surface, paint.reflect, dir, tag.path + hits_[i].t, stats);
    }
    if (!primary) stats.secondary_cpu_ms += thread_cpu_ms() - started_ms;
  }
}

template class RayGenerations<float>;
template class RayGenerations<double>;

}  // namespace hybridrt
