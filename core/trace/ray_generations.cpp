#include "core/trace/ray_generations.h"

#include "core/base/check.h"
#include "core/base/timing.h"
#include "core/trace/prefetch.h"
#include "core/trace/primary_surface.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

constexpr size_t kBatchRays = 4096;

template <typename Real, size_t kRoom>
Vec3<Real> triple(const Real (&values)[3][kRoom], int i) {
  return {values[0][i], values[1][i], values[2][i]};
}

}  // namespace

template <typename Real>
RayGenerations<Real>::RayGenerations(const TraceJob& job, const RayCaster<Real>* caster)
    : job_(job),
      caster_(caster),
      background_(job.background),
      asks_buffers_(job.has_buffers()),
      shadow_queues_(job.lights.size()) {
  HRT_CHECK(job.lights.size() <= HRT_MAX_LIGHTS);
  for (const TracedLight& traced : job.lights) to_light_.emplace_back(traced.light.toward);
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
  rays_.push_back(ray);
  tags_.push_back({Vec3<Real>(1), pixel, 0});
}

template <typename Real>
void RayGenerations<Real>::set_solid_angle(uint32_t pixel, Real solid_angle) {
  solid_angles_.resize(std::max<size_t>(solid_angles_.size(), pixel + 1));
  solid_angles_[pixel] = solid_angle;
}

template <typename Real>
void RayGenerations<Real>::add_seen(uint32_t pixel, uint32_t triangle, Real u, Real v, const Vec3<Real>& dir,
                                    Real distance, Real solid_angle, TraceStats& stats) {
  if (job_.scene.textures) set_solid_angle(pixel, solid_angle);
  add_hit({distance, u, v, triangle}, dir, {Vec3<Real>(1), pixel, 0});
  if (surfaces_.count == HitSurfaces<Real>::kMost) scatter_seen(stats);
}

/// Queues the rays of what was added by add_seen() since it last did.
template <typename Real>
void RayGenerations<Real>::scatter_seen(TraceStats& stats) {
  find_surfaces(job_.scene, surfaces_);
  scatter_on(stats);
  surfaces_.count = 0;
}

template <typename Real>
void RayGenerations<Real>::add_hit(const Hit<Real>& hit, const Vec3<Real>& dir, const Tag& tag) {
  const int i = surfaces_.count++;
  surfaces_.triangle[i] = hit.triangle;
  surfaces_.u[i] = hit.u, surfaces_.v[i] = hit.v;
  for (int k = 0; k < 3; ++k) surfaces_.dir[k][i] = dir[k];
  surface_tags_[i] = tag;
  surface_tags_[i].path += hit.t;
  if (!job_.scene.textures) return;
  surfaces_.distance[i] = surface_tags_[i].path;
  surfaces_.solid_angle[i] = solid_angles_[tag.pixel];
}

template <typename Real>
void RayGenerations<Real>::take_batch() {
  if (rays_.size() <= kBatchRays) {
    batch_rays_.swap(rays_), batch_tags_.swap(tags_);
    rays_.clear(), tags_.clear();
    return;
  }
  const size_t first = rays_.size() - kBatchRays;
  batch_rays_.assign(rays_.begin() + first, rays_.end());
  batch_tags_.assign(tags_.begin() + first, tags_.end());
  rays_.resize(first);
  tags_.resize(first);
}

/// Fills surfaces_ by hits of the batch from number `first`.
template <typename Real>
void RayGenerations<Real>::take_hits(size_t first, size_t end) {
  surfaces_.count = 0;
  for (size_t i = first; i < end; ++i) {
    if (!hits_[i].found()) continue;
    prefetch_numbers(job_.scene, hits_[i].triangle);
    add_hit(hits_[i], batch_rays_[i].dir, batch_tags_[i]);
  }
  for (int i = 0; i < surfaces_.count; ++i) prefetch_corners(job_.scene, surfaces_.triangle[i]);
  find_surfaces(job_.scene, surfaces_);
}

template <typename Real>
void RayGenerations<Real>::queue_query(size_t light, int i, ShadowQuery query) {
  query.anywhere = job_.eye_enclosed || surface_tags_[i].refracted;
  shadow_queues_[light].owners.push_back(i);
  shadow_queues_[light].queries.push_back(query);
}

/// Queues shadow rays to all lights that a primary ray's hit faces.
template <typename Real>
void RayGenerations<Real>::queue_as_seen(int i) {
  for_each_facing_light(job_.scene, surfaces_.triangle[i], job_.view.eye, primary_dirs_[surface_tags_[i].pixel],
                        job_.lights, [&](size_t l, const ShadowQuery& query) {
                          if (!job_.casts_shadow(l)) return;
                          lit_[i] |= 1u << l;
                          queue_query(l, i, query);
                        });
}

/// Queues a shadow ray to the light from every hit whose side faces it; a light without shadows arrives without one.
template <typename Real>
void RayGenerations<Real>::queue_shadow_rays(size_t light) {
  const bool asks = job_.casts_shadow(light);
  leave_toward(surfaces_, to_light_[light], shadow_origins_);
  for (int i = 0; i < surfaces_.count; ++i) {
    if (!shadow_origins_.facing[i]) continue;                                 // the unlit side needs no ray
    if (asks && asks_buffers_ && surface_tags_[i].generation == 0) continue;  // queue_as_seen
    lit_[i] |= 1u << light;
    if (!asks) continue;
    const Vec3<Real> origin = triple(shadow_origins_.origin, i);
    if (asks_buffers_) {
      queue_query(light, i, {dvec3(origin), surfaces_.triangle[i], surfaces_.from_outside[i] != 0});
    } else {
      shadow_queues_[light].owners.push_back(i);
      shadow_queues_[light].rays.push_back({origin, to_light_[light]});
    }
  }
}

/// Fills lit_: the lights that reach the surfaces.
template <typename Real>
void RayGenerations<Real>::ask_shadow_rays(TraceStats& stats) {
  for (ShadowQueue<Real>& queue : shadow_queues_) queue.clear();
  std::fill_n(lit_, surfaces_.count, 0);
  if (asks_buffers_)
    for (int i = 0; i < surfaces_.count; ++i)
      if (surface_tags_[i].generation == 0) queue_as_seen(i);
  for (size_t l = 0; l < shadow_queues_.size(); ++l) {
    queue_shadow_rays(l);
    ShadowQueue<Real>& queue = shadow_queues_[l];
    queue.answer(job_.lights[l], caster_);
    stats.shadow_rays += static_cast<int64_t>(queue.owners.size());
    for (size_t k = 0; k < queue.owners.size(); ++k) {
      const size_t i = queue.owners[k];
      stats.primary_shadow_rays += surface_tags_[i].generation == 0;
      if (queue.occluded[k]) lit_[i] &= ~(1u << l);
    }
  }
}

/// Adds what rays of the batch bring, in their order, as that decides how sums round.
template <typename Real>
void RayGenerations<Real>::add_light(size_t first, size_t end, std::span<Vec3<Real>> colors,
                                     std::span<PrimaryHit> primary_hits, TraceStats& stats) {
  shade_hits(job_, surfaces_, lit_, surface_colors_);
  int next = 0;
  for (size_t i = first; i < end; ++i) {
    const Tag& tag = batch_tags_[i];
    if (!hits_[i].found()) {
      colors[tag.pixel] += tag.weight * background_;
      continue;
    }
    const int surface = next++;
    if (tag.generation == 0) {
      primary_hits[tag.pixel] = {hits_[i].triangle, lit_[surface]};
      ++stats.pixels_hit;
    }
    colors[tag.pixel] += tag.weight * triple(surface_colors_, surface);
  }
}

/// Queues the rays that the surfaces reflect and refract.
template <typename Real>
void RayGenerations<Real>::scatter_on(TraceStats& stats) {
  bool any = false;
  for (int i = 0; i < surfaces_.count; ++i) {
    const Tag& tag = surface_tags_[i];
    const Material& material = job_.scene.materials[surfaces_.material[i]];
    if (tag.generation == 0) {
      stats.pixels_reflective += material.reflective();
      stats.pixels_refractive += material.transmissive();
    }
    sends_rays_[i] = tag.generation < job_.reflection_depth && (material.reflective() || material.transmissive());
    any |= sends_rays_[i];
  }
  if (!any) return;
  scatter_all(job_.scene, surfaces_, scattered_);
  for (int i = 0; i < surfaces_.count; ++i) {
    if (!sends_rays_[i]) continue;
    stats.reflection_rays += push(scattered_.reflected, i, surface_tags_[i].refracted);
    stats.refraction_rays += push(scattered_.refracted, i, true);
  }
}

/// Queues the surface's ray, if that could be seen; returns how many.
template <typename Real>
int RayGenerations<Real>::push(const LeavingRays<Real>& rays, int i, bool refracted) {
  const Tag& from = surface_tags_[i];
  const Vec3<Real> weight = from.weight * triple(rays.weight, i);
  if (!(std::max({weight.x, weight.y, weight.z}) >= Real(kSmallestWeight))) return 0;
  rays_.push_back({triple(rays.origin, i), triple(rays.dir, i)});
  tags_.push_back({weight, from.pixel, from.generation + 1, refracted, from.path});
  return 1;
}

template <typename Real>
void RayGenerations<Real>::run(std::span<Vec3<Real>> colors, std::span<PrimaryHit> primary_hits, TraceStats& stats) {
  scatter_seen(stats);
  while (!rays_.empty()) {
    const double started_ms = thread_cpu_ms();
    take_batch();
    const bool primary = batch_tags_.front().generation == 0;
    hits_.resize(batch_rays_.size());
    caster_->closest_hits(batch_rays_, hits_);
    for (size_t first = 0; first < hits_.size(); first += HitSurfaces<Real>::kMost) {
      const size_t end = std::min(first + HitSurfaces<Real>::kMost, hits_.size());
      take_hits(first, end);
      const double before_shadows_ms = primary ? thread_cpu_ms() : 0;
      ask_shadow_rays(stats);
      if (primary) stats.shadow_cpu_ms += thread_cpu_ms() - before_shadows_ms;
      add_light(first, end, colors, primary_hits, stats);
      scatter_on(stats);
    }
    surfaces_.count = 0;
    if (!primary) stats.secondary_cpu_ms += thread_cpu_ms() - started_ms;
  }
}

template class RayGenerations<float>;
template class RayGenerations<double>;

}  // namespace hybridrt
