#pragma once

#include <span>
#include <vector>

#include "core/trace/ray_caster.h"
#include "core/trace/scatter.h"
#include "core/trace/shadow_queue.h"
#include "core/trace/texture_lookup.h"
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

  /// Queues the rays that a primary surface reflects and refracts. `reflect`: its Material::reflect, with textures.
  /// `dir` must be unit. `distance` from the eye and `solid_angle` of the pixel count only in scenes with textures.
  void add_scattered(uint32_t pixel, const Surface<Real>& surface, const Vec3<Real>& reflect, const Vec3<Real>& dir,
                     Real distance, Real solid_angle, TraceStats& stats);

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
  void find_surfaces();
  void queue_shadow_rays(size_t in_batch);
  void ask_shadow_rays(TraceStats& stats);
  Vec3<Real> color_of(size_t in_batch, const SurfaceColors<Real>& paint) const;
  SurfaceColors<Real> colors_of(size_t in_batch) const;
  void scatter_on(const Tag& from, const Surface<Real>& surface, const Vec3<Real>& reflect, const Vec3<Real>& dir,
                  Real path, TraceStats& stats);
  void push(const Ray<Real>& ray, const Tag& tag);

  const TraceJob& job_;
  const RayCaster<Real>* caster_;
  const Vec3<Real> ambient_, ambient_slope_, background_;
  std::vector<Vec3<Real>> to_light_, light_color_;  ///< one per light
  const bool asks_buffers_;

  std::vector<Ray<Real>> rays_;  ///< the queue, newest last
  std::vector<Tag> tags_;
  std::vector<dvec3> primary_dirs_;  ///< one per pixel of the tile, as for_each_facing_light takes them
  std::vector<Real> solid_angles_;   ///< one per pixel of the tile; only if the scene has textures

  // The current batch.
  std::vector<Ray<Real>> batch_rays_;
  std::vector<Tag> batch_tags_;
  std::vector<Hit<Real>> hits_;
  std::vector<Surface<Real>> surfaces_;
  std::vector<ShadowQueue<Real>> shadow_queues_;  ///< one per light; owners are indices in the batch
  std::vector<uint8_t> lit_;                      ///< per hit, as PrimaryHit::lit
};

extern template class RayGenerations<float>;
extern template class RayGenerations<double>;

}  // namespace hybridrt
