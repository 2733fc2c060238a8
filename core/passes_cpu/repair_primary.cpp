#include "core/passes_cpu/repair_primary.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <vector>

#include "core/base/check.h"
#include "core/passes/misplaced_triangles.h"
#include "core/trace/holes.h"
#include "core/trace/primary_surface.h"
#include "core/trace/triangle.h"

namespace hybridrt {
namespace {

constexpr int kRowsPerChunk = 16;

/// A triangle as the eye sees it.
struct SeenTriangle {
  uint32_t id = kNoTriangle;
  vec3 edges[3];       ///< unit normals of the planes through the eye and an edge, pointing inward
  vec3 normal;         ///< unit, away from the eye
  float distance = 0;  ///< from the eye to its plane
  float reach = 0;     ///< from the eye to its farthest corner
  bool edge_on = false;

  SeenTriangle() = default;
  SeenTriangle(const Scene& scene, const dvec3& eye, uint32_t triangle) : id(triangle) {
    if (id == kNoTriangle) return;
    // In double: the corners of a large triangle may be far away while what is seen of it is near.
    const dvec3 a = dvec3(scene.vertex(id, 0)) - eye, b = dvec3(scene.vertex(id, 1)) - eye,
                c = dvec3(scene.vertex(id, 2)) - eye;
    const dvec3 across = glm::cross(b - a, c - a);
    const double turn = glm::dot(a, across) < 0 ? -1 : 1;
    edges[0] = directed(glm::cross(a, b), turn);
    edges[1] = directed(glm::cross(b, c), turn);
    edges[2] = directed(glm::cross(c, a), turn);
    normal = directed(across, turn);
    reach = static_cast<float>(std::sqrt(std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)})));
    distance = static_cast<float>(glm::dot(a, across) * turn / glm::length(across));
  }

  /// About the sine of the angle from `dir` (unit) to the nearest edge, positive inside.
  float depth_inside(const vec3& dir) const {
    return std::min({glm::dot(edges[0], dir), glm::dot(edges[1], dir), glm::dot(edges[2], dir)});
  }

 private:
  vec3 directed(const dvec3& v, double turn) {
    const double length = glm::length(v);
    edge_on |= !(length > 0);
    return vec3(v * (turn / length));
  }
};

/// What a pixel sees according to pass 2.
struct SeenPixel {
  SeenTriangle triangle;
  dvec3 dir{0};      ///< through its centre, unit
  float t = 0;       ///< distance of the triangle's plane along it
  float cosine = 0;  ///< between that plane's normal and `dir`
};

/// Three rows of a picture, moving downward.
class Neighbourhood {
 public:
  Neighbourhood(const Scene& scene, const View& view, std::span<const uint32_t> ids)
      : scene_(scene), view_(view), ids_(ids) {
    for (auto& row : rows_) row.resize(static_cast<size_t>(view.width_px) + 2);
  }

  /// Makes `y` the middle row: the first time any, then always the next.
  void go_to(int y, bool first) {
    if (first) fill(y - 1), fill(y);
    fill(y + 1);
  }

  const SeenPixel& at(int x, int y) const { return rows_[(y + 3) % 3][x + 1]; }

 private:
  void fill(int y) {
    std::vector<SeenPixel>& row = rows_[(y + 3) % 3];
    std::fill(row.begin(), row.end(), SeenPixel());
    if (y < 0 || y >= view_.height_px) return;
    const uint32_t* ids = &ids_[static_cast<size_t>(y) * view_.width_px];
    for (int x = 0; x < view_.width_px; ++x) {
      SeenPixel& pixel = row[x + 1];
      pixel.dir = glm::normalize(view_.pixel_dir(x, y));
      if (ids[x] == kNoTriangle) continue;
      pixel.triangle = ids[x] == row[x].triangle.id ? row[x].triangle : SeenTriangle(scene_, view_.eye, ids[x]);
      pixel.cosine = glm::dot(pixel.triangle.normal, vec3(pixel.dir));
      pixel.t = pixel.triangle.distance / pixel.cosine;
    }
  }

  const Scene& scene_;
  const View& view_;
  std::span<const uint32_t> ids_;
  std::array<std::vector<SeenPixel>, 3> rows_;
};

class Suspicion {
 public:
  explicit Suspicion(const View& view)
      : pixel_(static_cast<float>(pixel_angle(view))), snapping_(pixel_ / 256 + 4e-7f) {}

  bool may_be_hit(const SeenPixel& seen, const vec3& dir) const {
    return seen.triangle.edge_on || seen.triangle.depth_inside(dir) > -near_edge(seen);
  }

  bool falls_on(const Neighbourhood& seen, int x, int y) const {
    const SeenPixel& own = seen.at(x, y);
    bool alike = true;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) alike &= seen.at(x + dx, y + dy).triangle.id == own.triangle.id;
    if (alike) return false;

    const vec3 dir(own.dir);
    const bool hit = own.triangle.id != kNoTriangle;
    if (hit && (own.triangle.edge_on || own.cosine < kGrazing || own.triangle.depth_inside(dir) < near_edge(own)))
      return true;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const SeenPixel& other = seen.at(x + dx, y + dy);
        if (other.triangle.id == own.triangle.id) continue;
        if (!hit || other.triangle.id == kNoTriangle || is_step(own, other)) return true;  // a silhouette
        if (may_be_hit(other, dir)) return true;
      }
    return false;
  }

 private:
  /// The depth_inside() below which the raster may decide otherwise: it snaps vertices, and rounds far corners.
  float near_edge(const SeenPixel& seen) const {
    return snapping_ + static_cast<float>(kCornerError) * seen.triangle.reach / std::max(std::abs(seen.t), 1e-30f);
  }

  static constexpr float kGrazing = 0.05f, kSteps = 4;

  /// Whether no surface reaches from one pixel to the other without a silhouette between them.
  bool is_step(const SeenPixel& a, const SeenPixel& b) const {
    const float cosine = std::max(std::min(a.cosine, b.cosine), kGrazing);
    return std::abs(a.t - b.t) > kSteps * pixel_ * std::min(a.t, b.t) / cosine;
  }

  float pixel_;     ///< the angle of a pixel
  float snapping_;  ///< the angle that vertices are snapped by
};

/// Whether the triangle has a hole where the pixel's exact ray meets it; the raster rounds differently.
bool shows_hole(const Scene& scene, const dvec3& eye, const SeenPixel& pixel) {
  const uint32_t id = pixel.triangle.id;
  if (id == kNoTriangle || !scene.has_holes(id)) return false;
  const dvec3 weights = seen_barycentrics(scene, id, eye, pixel.dir);
  return is_hole(*scene.textures, id, weights.y, weights.z);
}

/// The nearest, along the exact ray, of the triangles around (x, y) and of those that `caster` finds.
class ExactHit {
 public:
  ExactHit(const Scene& scene, const SeenPixel& pixel, const dvec3& eye)
      : scene_(scene), ray_{eye, pixel.dir}, sheared_(shear_ray(eye, pixel.dir)), nearest_(ray_.t_min, ray_.t_max) {}

  /// Whether the ray meets it at all.
  bool offer(uint32_t id) {
    if (id == kNoTriangle) return false;
    const vec3 a = scene_.vertex(id, 0), b = scene_.vertex(id, 1), c = scene_.vertex(id, 2);
    TriangleHit<double> hit;
    if (is_degenerate(a, b, c) || !intersect_triangle(sheared_, a, b, c, hit)) return false;
    if (scene_.has_holes() && is_hole(*scene_.textures, id, hit.u, hit.v)) return false;
    if (id != nearest_.triangle) nearest_.offer(hit, id);
    return true;
  }

  void offer_neighbours(const Neighbourhood& seen, int x, int y, const Suspicion& suspicion) {
    const vec3 dir(ray_.dir);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const SeenPixel& other = seen.at(x + dx, y + dy);
        if (other.triangle.id != kNoTriangle && suspicion.may_be_hit(other, dir)) offer(other.triangle.id);
      }
  }

  /// Near an edge single precision may find the triangle on the wrong side of it: rays around this one find the other.
  void offer_around(const RayCaster<float>& caster, const View& view) {
    constexpr double kAside = 4e-7;
    const dvec3 sides[] = {view.right, -view.right, view.up, -view.up};
    Ray<float> rays[4];
    Hit<float> hits[4];
    for (int i = 0; i < 4; ++i) rays[i] = {vec3(ray_.origin), vec3(ray_.dir + kAside * sides[i])};
    caster.closest_hits(rays, hits);
    for (const Hit<float>& hit : hits) offer(hit.triangle);
  }

  /// Where single precision misplaces some triangles (in increasing order), `first`, the caster's hit, may be one of
  /// them, wrongly in front of another triangle, or may have missed one: offers them all, and what lies behind and
  /// beside `first`.
  void offer_despite(std::span<const uint32_t> misplaced, Hit<float> first, const RayCaster<float>& caster,
                     const View& view) {
    for (uint32_t id : misplaced) offer(id);
    if (std::binary_search(misplaced.begin(), misplaced.end(), first.triangle)) offer_around(caster, view);
    Ray<float> ray{vec3(ray_.origin), vec3(ray_.dir)};
    while (first.found() && std::binary_search(misplaced.begin(), misplaced.end(), first.triangle)) {
      ray.t_min = std::nextafter(first.t, std::numeric_limits<float>::infinity());
      caster.closest_hits({&ray, 1}, {&first, 1});
      offer(first.triangle);
    }
  }

  uint32_t triangle() const { return nearest_.triangle; }

 private:
  const Scene& scene_;
  const Ray<double> ray_;
  const ShearedRay<double> sheared_;
  NearestHit<double> nearest_;
};

/// What is needed to repair any row.
struct RepairJob {
  const Scene& scene;
  const View& view;
  const RayCaster<float>& caster;
  std::span<const uint32_t> ids;
  std::span<uint32_t> repaired;
  std::span<const uint32_t> misplaced;  ///< if there are any, every pixel is suspect
};

/// What the rows of a chunk gave.
struct RepairedRows {
  RepairStats stats;
  float nearest = std::numeric_limits<float>::infinity();  ///< distance of what pass 2 saw
};

uint32_t exact_triangle(const RepairJob& job, const Neighbourhood& seen, int x, int y, const Suspicion& suspicion,
                        const Hit<float>& hit) {
  ExactHit exact(job.scene, seen.at(x, y), job.view.eye);
  exact.offer_neighbours(seen, x, y, suspicion);
  if (hit.found() && !exact.offer(hit.triangle)) exact.offer_around(job.caster, job.view);
  if (!job.misplaced.empty()) exact.offer_despite(job.misplaced, hit, job.caster, job.view);
  return exact.triangle();
}

RepairedRows repair_rows(const RepairJob& job, const Suspicion& suspicion, size_t begin, size_t end) {
  const View& view = job.view;
  Neighbourhood seen(job.scene, view, job.ids);
  RepairedRows done;
  std::vector<int> suspects;
  std::vector<Ray<float>> rays;
  std::vector<Hit<float>> hits;
  for (size_t row = begin; row < end; ++row) {
    const int y = static_cast<int>(row);
    seen.go_to(y, row == begin);
    suspects.clear(), rays.clear();
    for (int x = 0; x < view.width_px; ++x) {
      const size_t pixel = row * view.width_px + x;
      job.repaired[pixel] = job.ids[pixel];
      const SeenPixel& own = seen.at(x, y);
      if (own.triangle.id != kNoTriangle && own.t > 0) done.nearest = std::min(done.nearest, own.t);
      if (job.misplaced.empty() && !suspicion.falls_on(seen, x, y) && !shows_hole(job.scene, view.eye, own)) continue;
      suspects.push_back(x);
      rays.push_back({vec3(view.eye), vec3(own.dir)});
    }
    hits.resize(rays.size());
    job.caster.closest_hits(rays, hits);
    for (size_t i = 0; i < suspects.size(); ++i) {
      uint32_t& id = job.repaired[row * view.width_px + suspects[i]];
      const uint32_t exact = exact_triangle(job, seen, suspects[i], y, suspicion, hits[i]);
      done.stats.repaired += exact != id;
      id = exact;
    }
    done.stats.suspects += static_cast<int64_t>(suspects.size());
  }
  return done;
}

RepairedRows repair_picture(const RepairJob& job, ThreadPool& pool) {
  const Suspicion suspicion(job.view);
  RepairedRows total;
  std::mutex mutex;
  parallel_for(pool, static_cast<size_t>(job.view.height_px), kRowsPerChunk, [&](size_t begin, size_t end) {
    const RepairedRows done = repair_rows(job, suspicion, begin, end);
    std::lock_guard lock(mutex);
    total.stats.suspects += done.stats.suspects;
    total.stats.repaired += done.stats.repaired;
    total.nearest = std::min(total.nearest, done.nearest);
  });
  return total;
}

/// The distance of the nearest thing that may be in view, if pass 2 saw nothing nearer than `seen`.
double nearest_possible(const Scene& scene, const View& view, float seen) {
  if (std::isfinite(seen)) return seen;
  const dvec3 outside = glm::max(dvec3(scene.bounds.lo) - view.eye, view.eye - dvec3(scene.bounds.hi));
  return glm::length(glm::max(outside, dvec3(0)));
}

}  // namespace

RepairStats repair_primary_hits(const Scene& scene, const View& view, const RayCaster<float>& caster, ThreadPool& pool,
                                std::span<const uint32_t> ids, std::span<uint32_t> repaired) {
  HRT_CHECK_EQ(ids.size(), repaired.size());
  const RepairedRows usual = repair_picture({scene, view, caster, ids, repaired, {}}, pool);
  if (!may_be_misplaced(scene, view, nearest_possible(scene, view, usual.nearest))) return usual.stats;
  const std::vector<uint32_t> misplaced = misplaced_triangles(scene, view);
  if (misplaced.empty()) return usual.stats;
  return repair_picture({scene, view, caster, ids, repaired, misplaced}, pool).stats;
}

}  // namespace hybridrt
