#include "core/passes_cpu/repair_primary.h"

#include <array>
#include <mutex>
#include <vector>

#include "core/base/check.h"
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
  bool edge_on = false;

  SeenTriangle() = default;
  SeenTriangle(const Scene& scene, const dvec3& eye, uint32_t triangle) : id(triangle) {
    if (id == kNoTriangle) return;
    const dvec3 corners[] = {dvec3(scene.vertex(id, 0)), dvec3(scene.vertex(id, 1)), dvec3(scene.vertex(id, 2))};
    const vec3 a(corners[0] - eye), e1(corners[1] - corners[0]), e2(corners[2] - corners[0]);
    for (int i = 0; i < 3; ++i) {  // from the edge: the product of two far corners would lose its digits
      const dvec3 &from = corners[i], &to = corners[(i + 1) % 3];
      edges[i] = glm::cross(vec3(from - eye), vec3(to - from));
    }
    normal = glm::cross(e1, e2);
    const float turn = glm::dot(a, normal) < 0 ? -1.0f : 1.0f;
    for (vec3& edge : edges) edge_on |= !set_length(edge, turn);
    edge_on |= !set_length(normal, turn);
    distance = glm::dot(a, normal);
  }

  /// About the sine of the angle from `dir` (unit) to the nearest edge, positive inside.
  float depth_inside(const vec3& dir) const {
    return std::min({glm::dot(edges[0], dir), glm::dot(edges[1], dir), glm::dot(edges[2], dir)});
  }

 private:
  static bool set_length(vec3& v, float length) {
    const float now = glm::length(v);
    v *= length / now;
    return now > 0;
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
      : pixel_(static_cast<float>(2 * view.tan_half_height / view.frame_height_px)), near_edge_(pixel_ / 256 + 4e-7f) {}

  bool may_be_hit(const SeenTriangle& triangle, const vec3& dir) const {
    return triangle.edge_on || triangle.depth_inside(dir) > -near_edge_;
  }

  bool falls_on(const Neighbourhood& seen, int x, int y) const {
    const SeenPixel& own = seen.at(x, y);
    bool alike = true;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) alike &= seen.at(x + dx, y + dy).triangle.id == own.triangle.id;
    if (alike) return false;

    const vec3 dir(own.dir);
    const bool hit = own.triangle.id != kNoTriangle;
    if (hit && (own.triangle.edge_on || own.cosine < kGrazing || own.triangle.depth_inside(dir) < near_edge_))
      return true;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const SeenPixel& other = seen.at(x + dx, y + dy);
        if (other.triangle.id == own.triangle.id) continue;
        if (!hit || other.triangle.id == kNoTriangle || is_step(own, other)) return true;  // a silhouette
        if (may_be_hit(other.triangle, dir)) return true;
      }
    return false;
  }

 private:
  static constexpr float kGrazing = 0.05f, kSteps = 4;

  /// Whether no surface reaches from one pixel to the other without a silhouette between them.
  bool is_step(const SeenPixel& a, const SeenPixel& b) const {
    const float cosine = std::max(std::min(a.cosine, b.cosine), kGrazing);
    return std::abs(a.t - b.t) > kSteps * pixel_ * std::min(a.t, b.t) / cosine;
  }

  float pixel_;      ///< the angle of a pixel
  float near_edge_;  ///< depth_inside() below which the raster may decide otherwise
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
        const SeenTriangle& triangle = seen.at(x + dx, y + dy).triangle;
        if (triangle.id != kNoTriangle && suspicion.may_be_hit(triangle, dir)) offer(triangle.id);
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

  uint32_t triangle() const { return nearest_.triangle; }

 private:
  const Scene& scene_;
  const Ray<double> ray_;
  const ShearedRay<double> sheared_;
  NearestHit<double> nearest_;
};

}  // namespace

RepairStats repair_primary_hits(const Scene& scene, const View& view, const RayCaster<float>& caster, ThreadPool& pool,
                                std::span<const uint32_t> ids, std::span<uint32_t> repaired) {
  HRT_CHECK_EQ(ids.size(), repaired.size());
  const Suspicion suspicion(view);
  RepairStats total;
  std::mutex mutex;
  parallel_for(pool, static_cast<size_t>(view.height_px), kRowsPerChunk, [&](size_t begin, size_t end) {
    Neighbourhood seen(scene, view, ids);
    RepairStats stats;
    std::vector<int> suspects;
    std::vector<Ray<float>> rays;
    std::vector<Hit<float>> hits;
    for (size_t row = begin; row < end; ++row) {
      const int y = static_cast<int>(row);
      seen.go_to(y, row == begin);
      suspects.clear(), rays.clear();
      for (int x = 0; x < view.width_px; ++x) {
        const size_t pixel = row * view.width_px + x;
        repaired[pixel] = ids[pixel];
        if (!suspicion.falls_on(seen, x, y) && !shows_hole(scene, view.eye, seen.at(x, y))) continue;
        suspects.push_back(x);
        rays.push_back({vec3(view.eye), vec3(seen.at(x, y).dir)});
      }
      hits.resize(rays.size());
      caster.closest_hits(rays, hits);
      for (size_t i = 0; i < suspects.size(); ++i) {
        uint32_t& id = repaired[row * view.width_px + suspects[i]];
        ExactHit exact(scene, seen.at(suspects[i], y), view.eye);
        exact.offer_neighbours(seen, suspects[i], y, suspicion);
        if (hits[i].found() && !exact.offer(hits[i].triangle)) exact.offer_around(caster, view);
        stats.repaired += exact.triangle() != id;
        id = exact.triangle();
      }
      stats.suspects += static_cast<int64_t>(suspects.size());
    }
    std::lock_guard lock(mutex);
    total.suspects += stats.suspects;
    total.repaired += stats.repaired;
  });
  return total;
}

}  // namespace hybridrt
