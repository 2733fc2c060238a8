#pragma once

#include <span>
#include <vector>

#include "core/trace/hit_shading.h"
#include "core/trace/ray_caster.h"
#include "core/trace/shadow_queue.h"
#include "core/trace/trace_job.h"

namespace hybridrt {

/// Rays of less weight end: their light could not change an 8-bit pixel.
inline constexpr float kSmallestWeight = 1.0f / 1024;

/// The paper's generations of rays (section 3.2), for one tile of the picture on one thread: rays wait in a queue; a
/// step takes the newest batch, intersects it, asks its shadow rays, shades its hits into the tile's pixels, and queues
/// the rays that the hits send on. Taking the newest first bounds the queue to tile rays + 2 x batch x depth, however
/// often rays branch; while a generation fits a batch, one step is one generation.
template <typename Real>
class RayGenerations {
 public:
  /// `caster` may be null if no ray is ever added.
  RayGenerations(const TraceJob& job, const RayCaster<Real>* caster);

  /// What a primary ray found; see trace_frame.
  struct PrimaryHit {
    uint32_t triangle = kNoTriangle;
    uint8_t lit = 0;  ///< bit i: light i arrives
  };

  /// Queues the ray through the centre of a pixel; `pixel` is its place in the tile.
  void add_primary(uint32_t pixel, int x, int y);

  /// Takes a point of a triangle that the eye sees along `dir` (unit), which may send rays; u and v as in Hit.
  /// `distance` from the eye and `solid_angle` of the pixel count only in scenes with textures.
  void add_seen(uint32_t pixel, uint32_t triangle, Real u, Real v, const Vec3<Real>& dir, Real distance,
                Real solid_angle, TraceStats& stats);

  /// Runs until the queue is empty. Adds light to `colors` (one per pixel of the tile). `primary_hits` is filled for
  /// primary rays; it may be empty when none were added.
  void run(std::span<Vec3<Real>> colors, std::span<PrimaryHit> primary_hits, TraceStats& stats);

 private:
  struct Tag {
    Vec3<Real> weight;
    uint32_t pixel;
    int generation;          ///< 0: primary
    bool refracted = false;  ///< it may travel inside a closed body
    Real path = 0;           ///< distance from the eye to its origin
  };

  void set_solid_angle(uint32_t pixel, Real solid_angle);
  void take_batch();
  void add_hit(const Hit<Real>& hit, const Vec3<Real>& dir, const Tag& tag);
  void scatter_seen(TraceStats& stats);
  void take_hits(size_t first, size_t end);
  void queue_query(size_t light, int i, ShadowQuery query);
  void queue_as_seen(int i);
  void queue_shadow_rays(size_t light);
  void ask_shadow_rays(TraceStats& stats);
  void add_light(size_t first, size_t end, std::span<Vec3<Real>> colors, std::span<PrimaryHit> primary_hits,
                 TraceStats& stats);
  void scatter_on(TraceStats& stats);
  int push(const LeavingRays<Real>& rays, int i, bool refracted);

  const TraceJob& job_;
  const RayCaster<Real>* caster_;
  const Vec3<Real> background_;
  std::vector<Vec3<Real>> to_light_;  ///< one per light
  const bool asks_buffers_;

  std::vector<Ray<Real>> rays_;  ///< the queue, newest last
  std::vector<Tag> tags_;
  std::vector<dvec3> primary_dirs_;  ///< one per pixel of the tile, as for_each_facing_light takes them
  std::vector<Real> solid_angles_;   ///< one per pixel of the tile; only if the scene has textures

  // The current batch.
  std::vector<Ray<Real>> batch_rays_;
  std::vector<Tag> batch_tags_;
  std::vector<Hit<Real>> hits_;

  // Few of its hits at a time, so that what is found of them stays in the cache.
  HitSurfaces<Real> surfaces_;
  Tag surface_tags_[HitSurfaces<Real>::kMost];  ///< of the rays that met them; `path`: to the surface
  uint8_t lit_[HitSurfaces<Real>::kMost];       ///< as PrimaryHit::lit
  bool sends_rays_[HitSurfaces<Real>::kMost];
  Real surface_colors_[3][HitSurfaces<Real>::kRoom];
  ShadowOrigins<Real> shadow_origins_;
  std::vector<ShadowQueue<Real>> shadow_queues_;  ///< one per light; owners are numbers of surfaces
  ScatteredFromHits<Real> scattered_;
};

extern template class RayGenerations<float>;
extern template class RayGenerations<double>;

}  // namespace hybridrt
