// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_CLUSTER_TRIANGLES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_CLUSTER_TRIANGLES_H
#undef HYBRIDRT_RASTER_CLUSTER_TRIANGLES_H
#else
#define HYBRIDRT_RASTER_CLUSTER_TRIANGLES_H
#endif

#include <cmath>
#include <optional>

#include "core/raster/cluster_scratch-inl.h"
#include "core/raster/hole_lanes-inl.h"
#include "core/raster/homogeneous.h"
#include "core/raster/tile_depth-inl.h"
#include "core/raster/vertex_table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// How far off single precision may be for the vertices of a cluster.
struct VertexError {
  float pixels;          ///< of a vertex on the screen, along x and along y
  float depth_relative;  ///< of unit / distance
};

/// Triangles ready to be sampled, one a lane; see EdgeTriangle.
struct LaneTriangles {
  Floats edge[3], dx[3], dy[3], error;
  Floats depth, depth_dx, depth_dy, depth_error, nearest;
  Floats box_x0, box_x1, box_y0, box_y1;
  Ints number;  ///< in the cluster
};

/// The same in memory, to be taken one by one.
struct StoredTriangles {
  HWY_ALIGN float edge[3][kLongestVector], dx[3][kLongestVector], dy[3][kLongestVector], x_per_dx[3][kLongestVector];
  HWY_ALIGN float error[kLongestVector], depth[kLongestVector], depth_dx[kLongestVector], depth_dy[kLongestVector];
  HWY_ALIGN float depth_error[kLongestVector], nearest[kLongestVector], box[4][kLongestVector];
  HWY_ALIGN int32_t number[kLongestVector];

  explicit StoredTriangles(const LaneTriangles& t) {
    for (int k = 0; k < 3; ++k) {
      store(edge[k], t.edge[k]), store(dx[k], t.dx[k]), store(dy[k], t.dy[k]);
      store(x_per_dx[k], all(-1) / t.dx[k]);
    }
    store(error, t.error), store(depth, t.depth), store(depth_dx, t.depth_dx), store(depth_dy, t.depth_dy);
    store(depth_error, t.depth_error), store(nearest, t.nearest), store_int(number, t.number);
    store(box[0], t.box_x0), store(box[1], t.box_y0), store(box[2], t.box_x1), store(box[3], t.box_y1);
  }

  /// The box of the one in lane `i`, from (x, y) on.
  PixelBox box_of(int i, int x, int y) const {
    return {static_cast<int>(box[0][i]) + x, static_cast<int>(box[1][i]) + y, static_cast<int>(box[2][i]) + x,
            static_cast<int>(box[3][i]) + y};
  }
  /// All of it but for its index and whether it has holes.
  EdgeTriangle edges_of(int i, const PixelBox& in_tile) const {
    EdgeTriangle one;
    for (int k = 0; k < 3; ++k) {
      one.edge[k] = edge[k][i], one.dx[k] = dx[k][i], one.dy[k] = dy[k][i], one.error[k] = error[i];
      one.x_per_dx[k] = x_per_dx[k][i];
    }
    one.depth = depth[i], one.depth_dx = depth_dx[i], one.depth_dy = depth_dy[i], one.depth_error = depth_error[i];
    one.nearest = nearest[i];
    one.box = in_tile;
    return one;
  }
};

/// The triangles of a cluster, ready for one tile.
///
/// Vertices. With o a vertex's offset from the centre c, d = c - eye, Z = d.forward + o.forward, and A = scale right -
/// (x(c) - middle) forward / ..., the vertex falls at x(c) + (A.o) / Z: numerator and quotient are of the cluster's
/// size, not the screen's, and that is what makes float enough. docs/method.md derives how far off it may be:
///   Z           rho = 8u (Zc + r) / Zmin, relative, r the cluster's radius and u = 2^-24
///   x, y        u (R (8.5 + 8.8 (Zc + r) / Zmin) + 3) pixels, R = |A| r / Zmin its radius in pixels, and what double
///               precision adds to the centre
/// Edge functions, over a box of width + height + 2 + 2 s = S pixels, s the spread of samples (Screen::spread_px):
/// error = S (2.1 delta + (5 + 4 s) u S), delta that of the vertices; a triangle with less than four times that as
/// twice its area goes the homogeneous way. Depth is linear on
/// the screen: error_depth = 8 range error / |twice area| + 8 (rho + 2u) largest. It holds with and without fused
/// operations.
/// Texels of holes: see place_holes().
class ClusterTriangles {
 public:
  ClusterTriangles(const Scene& scene, const Clusters& clusters, const Screen& screen, ClusterScratch& scratch,
                   DepthTile& tile)
      : scene_(scene),
        clusters_(clusters),
        screen_(screen),
        spread_(static_cast<float>(screen.spread_px)),
        scratch_(scratch),
        tile_(tile) {}

  /// Begins with a cluster. `box`: pixels of the picture that it may touch in the tile. Returns how many of its
  /// triangles may touch one; 0 if all of it is hidden.
  int begin(const Cluster& cluster, PixelBox box) {
    cluster_ = &cluster;
    triangles_ = clusters_.triangles(cluster);
    return project_vertices(box) ? gather_triangles(box) : 0;
  }

  /// The triangles from number `first` on, of which `live` are there. `sliver`: those whose edges are too uncertain.
  LaneTriangles set_up(int first, Mask live, Mask& sliver) {
    const ClusterScratch& s = scratch_;
    Floats x[3], y[3], w[3];
    const Ints packed = load_int(s.corners + first);
    const Ints number[3] = {packed, hn::ShiftRight<8>(packed), hn::ShiftRight<16>(packed)};
    const VertexTable table_depth(s.depth);
    for (int k = 0; k < 3; ++k)
      x[k] = load(s.corner_x[k] + first), y[k] = load(s.corner_y[k] + first), w[k] = table_depth[number[k]];
    LaneTriangles t;
    t.box_x0 = load(s.box_x0 + first), t.box_x1 = load(s.box_x1 + first);
    t.box_y0 = load(s.box_y0 + first), t.box_y1 = load(s.box_y1 + first);
    t.number = hn::And(hn::ShiftRight<24>(packed), all_int(kClusterTriangles - 1));

    // Edge k lies opposite corner k.
    Floats dx[3], dy[3];
    for (int k = 0; k < 3; ++k) dx[k] = y[(k + 1) % 3] - y[(k + 2) % 3], dy[k] = x[(k + 2) % 3] - x[(k + 1) % 3];
    const Floats twice_area = sum_of(dx[2], x[2] - x[0], dy[2] * (y[2] - y[0]));
    const Floats area = hn::Abs(twice_area);
    const Floats width = hn::Max(hn::Max(x[0], x[1]), x[2]) - hn::Min(hn::Min(x[0], x[1]), x[2]);
    const Floats height = hn::Max(hn::Max(y[0], y[1]), y[2]) - hn::Min(hn::Min(y[0], y[1]), y[2]);
    const Floats size = (width + height) + all(2 + 2 * spread_);
    t.error = size * sum_of(size, all((5 + 4 * spread_) * kU), all(2.1f * error_.pixels));
    sliver = hn::And(live, hn::Lt(area, t.error * all(4)));
    for (int k = 0; k < 3; ++k) {
      t.dx[k] = hn::CopySignToAbs(all(1), twice_area) * dx[k];
      t.dy[k] = hn::CopySignToAbs(all(1), twice_area) * dy[k];
      t.edge[k] = sum_of(t.dx[k], t.box_x0 - x[(k + 1) % 3], t.dy[k] * (t.box_y0 - y[(k + 1) % 3]));
    }
    const Floats per_area = all(1) / area, step_1 = w[1] - w[0], step_2 = w[2] - w[0];
    t.depth_dx = sum_of(t.dx[1], step_1, t.dx[2] * step_2) * per_area;
    t.depth_dy = sum_of(t.dy[1], step_1, t.dy[2] * step_2) * per_area;
    t.depth = sum_of(sum_of(t.edge[1], step_1, t.edge[2] * step_2), per_area, w[0]);
    const Floats most = hn::Max(hn::Max(w[0], w[1]), w[2]), range = most - hn::Min(hn::Min(w[0], w[1]), w[2]);
    t.depth_error = sum_of(all(8) * range, t.error * per_area, all(8 * error_.depth_relative) * most);
    t.nearest = most * all(1 + 4 * error_.depth_relative + 1e-6f);
    if (cluster_->has_holes) {
      const float margin = 1 + 2 * spread_;
      const Floats rounding = (width + all(margin)) * (height + all(margin)) * (all(96 * kU) * per_area);
      place_holes(t, live, w, per_area, range, rounding);
    }
    return t;
  }

  /// Of the triangles that were set up last: their holes, a triangle a lane, or of the one in lane `i` in all lanes.
  /// Nothing where there are none.
  std::optional<HoleLanes> holes() const {
    if (!cluster_->has_holes) return std::nullopt;
    return HoleLanes(*scene_.textures, holes_);
  }
  std::optional<HoleLanes> holes_of(int i) const {
    if (!cluster_->has_holes) return std::nullopt;
    return HoleLanes(*scene_.textures, holes_, i);
  }

  /// One of these, in lane `i`; its box in the tile.
  PixelBox box_of(const StoredTriangles& t, int i) const { return t.box_of(i, to_tile_x(), to_tile_y()); }
  EdgeTriangle edges_of(const StoredTriangles& t, int i) const {
    EdgeTriangle one = t.edges_of(i, box_of(t, i));
    one.triangle = triangles_[t.number[i]], one.has_holes = cluster_->has_holes;
    return one;
  }

  /// The slivers of `bits`: each(triangle, its box in the picture).
  template <typename Each>
  void for_each_sliver(const LaneTriangles& t, uint32_t bits, const Each& each) const {
    if (bits == 0) return;
    const StoredTriangles stored(t);
    for (; bits != 0; bits &= bits - 1) {
      const int i = __builtin_ctz(bits);
      each(make_homogeneous(scene_, screen_, triangles_[stored.number[i]], stored.nearest[i]),
           stored.box_of(i, base_x_, base_y_));
    }
  }

  const uint32_t* indices() const { return triangles_; }  ///< in the scene, by number in the cluster
  int to_tile_x() const { return base_x_ - tile_.x_px; }  ///< from a triangle's box to pixels of the tile
  int to_tile_y() const { return base_y_ - tile_.y_px; }

 private:
  /// False if the cluster's vertices show that it is hidden or touches no pixel of the box, which shrinks to them.
  bool project_vertices(PixelBox& box) {
    const dvec3 d = dvec3(cluster_->center) - screen_.eye;
    const double x = glm::dot(d, screen_.right), y = glm::dot(d, screen_.up), z = glm::dot(d, screen_.forward);
    const double from_middle_x = screen_.scale_x * x / z, from_middle_y = -screen_.scale_y * y / z;
    const dvec3 across = screen_.scale_x * screen_.right - from_middle_x * screen_.forward;
    const dvec3 down = -screen_.scale_y * screen_.up - from_middle_y * screen_.forward;
    const double center_x = from_middle_x + screen_.middle_x, center_y = from_middle_y + screen_.middle_y;
    base_x_ = static_cast<int>(std::floor(center_x)), base_y_ = static_cast<int>(std::floor(center_y));
    const Floats fraction_x = all(static_cast<float>(center_x - base_x_));
    const Floats fraction_y = all(static_cast<float>(center_y - base_y_));
    const auto product = [](const dvec3& axis, Floats ox, Floats oy, Floats oz) {
      const Floats rest = sum_of(all(static_cast<float>(axis.y)), oy, all(static_cast<float>(axis.z)) * oz);
      return sum_of(all(static_cast<float>(axis.x)), ox, rest);
    };

    const float* const offsets = clusters_.offsets(*cluster_);
    const int stride = Clusters::padded(cluster_->vertex_count);
    Floats least_z = all(3e38f), least_x = least_z, least_y = least_z, most_x = all(-3e38f), most_y = most_x;
    for (int i = 0; i < cluster_->vertex_count; i += kLanes) {
      // Offsets that fill up the last vector are 0: the centre, which lies among the vertices.
      const Floats ox = load(offsets + i), oy = load(offsets + stride + i), oz = load(offsets + 2 * stride + i);
      const Floats distance = product(screen_.forward, ox, oy, oz) + all(static_cast<float>(z));
      const Floats per_distance = all(1) / distance;
      const Floats px = sum_of(product(across, ox, oy, oz), per_distance, fraction_x);
      const Floats py = sum_of(product(down, ox, oy, oz), per_distance, fraction_y);
      least_z = hn::Min(least_z, distance);
      least_x = hn::Min(least_x, px), most_x = hn::Max(most_x, px);
      least_y = hn::Min(least_y, py), most_y = hn::Max(most_y, py);
      store(scratch_.x + i, px), store(scratch_.y + i, py);
      store(scratch_.depth + i, per_distance * all(static_cast<float>(screen_.unit)));
    }

    const double radius = cluster_->radius;
    const double nearest = std::max(static_cast<double>(smallest(least_z)) - 8 * kU * (z + radius), 1e-300);
    const double ratio = (z + radius) / nearest;
    const double radius_px = std::sqrt(std::max(glm::dot(across, across), glm::dot(down, down))) * radius / nearest;
    const double slant = glm::length(d) / z;
    const double of_double = 0x1p-47 * slant *
                             (screen_.scale_x + screen_.scale_y + std::abs(from_middle_x) + std::abs(from_middle_y) +
                              screen_.width_px + screen_.height_px);
    error_.pixels = static_cast<float>((kU * (radius_px * (8.5 + 8.8 * ratio) + 3) + of_double) * 1.01);
    error_.depth_relative = static_cast<float>(kU * (8 * ratio + 2));

    const float reach = error_.pixels + spread_;
    box.x0 = std::max(box.x0, base_x_ + static_cast<int>(std::ceil(smallest(least_x) - reach)));
    box.y0 = std::max(box.y0, base_y_ + static_cast<int>(std::ceil(smallest(least_y) - reach)));
    box.x1 = std::min(box.x1, base_x_ + static_cast<int>(std::floor(largest(most_x) + reach)));
    box.y1 = std::min(box.y1, base_y_ + static_cast<int>(std::floor(largest(most_y) + reach)));
    if (box.x0 > box.x1 || box.y0 > box.y1) return false;
    const PixelBox in_tile{box.x0 - tile_.x_px, box.y0 - tile_.y_px, box.x1 - tile_.x_px, box.y1 - tile_.y_px};
    return !hides(tile_, in_tile, static_cast<float>(screen_.unit / nearest * (1 + 1e-6)));
  }

  /// Where the triangles' texels fall on the screen. `w`: unit / distance of the corners; `range`: between these.
  /// `rounding`: 96u box / |twice area|, of a function that is at most 1 at the corners. Inside the triangle, with T
  /// the range of a texture coordinate over the corners, N and D what is linear on the screen, the coordinate is off by
  ///   (T (rounding (largest + range) + (2 (rho + 2u) + 4u) largest) + 1.5 delta (|N'| + T |D'|)) / (least -
  ///   error_depth)
  ///   + 4u (T + |start| + 1), and what double precision rounds.
  void place_holes(const LaneTriangles& t, Mask live, const Floats (&w)[3], Floats per_area, Floats range,
                   Floats rounding) {
    HWY_ALIGN float to[2][2][kLongestVector] = {}, error[2][kLongestVector] = {};
    HWY_ALIGN int32_t number[kLongestVector];
    store_int(number, t.number);
    for (uint32_t bits = bits_of(live); bits != 0; bits &= bits - 1) {
      const int i = __builtin_ctz(bits);
      const HolePlacement one = hole_placement(*scene_.textures, triangles_[number[i]]);
      for (int axis = 0; axis < 2; ++axis) {
        to[0][axis][i] = one.to[0][axis], to[1][axis][i] = one.to[1][axis], error[axis][i] = one.error[axis];
        holes_.start[axis][i] = one.start[axis], holes_.size[axis][i] = one.size[axis];
      }
      holes_.first[i] = one.first, holes_.repeats[i] = !one.clamped;
    }
    const Floats most = hn::Max(hn::Max(w[0], w[1]), w[2]);
    const Floats least = hn::Max((most - range) - t.depth_error, all(0));
    const Floats depth_steps = hn::Abs(t.depth_dx) + hn::Abs(t.depth_dy);
    const Floats of_depth = sum_of(rounding, most + range, all(2 * error_.depth_relative + 4 * kU) * most);
    for (int axis = 0; axis < 2; ++axis) {
      const Floats to_1 = load(to[0][axis]), to_2 = load(to[1][axis]), q_1 = to_1 * w[1], q_2 = to_2 * w[2];
      const Floats dx = sum_of(t.dx[1], q_1, t.dx[2] * q_2) * per_area;
      const Floats dy = sum_of(t.dy[1], q_1, t.dy[2] * q_2) * per_area;
      store(holes_.at[axis], sum_of(t.edge[1], q_1, t.edge[2] * q_2) * per_area);
      store(holes_.dx[axis], dx), store(holes_.dy[axis], dy);
      const Floats size = hn::Max(hn::Max(to_1, to_2), all(0)) - hn::Min(hn::Min(to_1, to_2), all(0));
      const Floats steps = sum_of(size, depth_steps, hn::Abs(dx) + hn::Abs(dy));
      const Floats of_place = sum_of(size, of_depth, all(1.5f * error_.pixels) * steps) / least;
      const Floats of_start = all(4 * kU) * (size + hn::Abs(load(holes_.start[axis])) + all(1)) + load(error[axis]);
      store(holes_.error[axis], (of_place + of_start) * all(1.01f));
    }
  }

  /// Keeps the triangles whose box holds a pixel of `box`; returns how many.
  int gather_triangles(const PixelBox& box) {
    const Floats left = all(static_cast<float>(box.x0 - base_x_)), right = all(static_cast<float>(box.x1 - base_x_));
    const Floats top = all(static_cast<float>(box.y0 - base_y_)), bottom = all(static_cast<float>(box.y1 - base_y_));
    const Floats reach = all(error_.pixels + spread_);
    const VertexTable table_x(scratch_.x), table_y(scratch_.y);
    const uint32_t* const corners = clusters_.corners(*cluster_);
    ClusterScratch& s = scratch_;
    int count = 0;
    for (int first = 0; first < cluster_->triangle_count; first += kLanes) {
      const Ints packed = load_int(corners + first);
      const Ints number[3] = {packed, hn::ShiftRight<8>(packed), hn::ShiftRight<16>(packed)};
      Floats x[3], y[3];
      for (int k = 0; k < 3; ++k) x[k] = table_x[number[k]], y[k] = table_y[number[k]];
      const Floats x0 = hn::Max(hn::Ceil(hn::Min(hn::Min(x[0], x[1]), x[2]) - reach), left);
      const Floats x1 = hn::Min(hn::Floor(hn::Max(hn::Max(x[0], x[1]), x[2]) + reach), right);
      const Floats y0 = hn::Max(hn::Ceil(hn::Min(hn::Min(y[0], y[1]), y[2]) - reach), top);
      const Floats y1 = hn::Min(hn::Floor(hn::Max(hn::Max(y[0], y[1]), y[2]) + reach), bottom);
      const Mask kept = hn::And(hn::And(hn::Le(x0, x1), hn::Le(y0, y1)), first_lanes(cluster_->triangle_count - first));
      const uint32_t bits = bits_of(kept);
      if (bits == 0) continue;
      const Chosen chosen(kept);
      for (int k = 0; k < 3; ++k)
        store(s.corner_x[k] + count, chosen(x[k])), store(s.corner_y[k] + count, chosen(y[k]));
      store(s.box_x0 + count, chosen(x0)), store(s.box_x1 + count, chosen(x1));
      store(s.box_y0 + count, chosen(y0)), store(s.box_y1 + count, chosen(y1));
      store_int(s.corners + count, chosen(packed));
      count += __builtin_popcount(bits);
    }
    return count;
  }

  const Scene& scene_;
  const Clusters& clusters_;
  const Screen& screen_;
  const float spread_;
  ClusterScratch& scratch_;
  DepthTile& tile_;

  // The cluster at hand.
  const Cluster* cluster_ = nullptr;
  const uint32_t* triangles_ = nullptr;
  int base_x_ = 0, base_y_ = 0;
  VertexError error_{};
  HoleTriangles holes_{};  ///< of the triangles that were set up last, where they have any
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
