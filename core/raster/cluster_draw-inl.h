// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_CLUSTER_DRAW_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_CLUSTER_DRAW_H
#undef HYBRIDRT_RASTER_CLUSTER_DRAW_H
#else
#define HYBRIDRT_RASTER_CLUSTER_DRAW_H
#endif

#include <cmath>

#include "core/raster/cluster_scratch-inl.h"
#include "core/raster/spans-inl.h"
#include "core/raster/vertex_table-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// How far off single precision may be for the vertices of a cluster.
struct VertexError {
  float pixels;          ///< of a vertex on the screen, along x and along y
  float depth_relative;  ///< of unit / distance
};

/// Draws one cluster into one tile.
///
/// Vertices. With o a vertex's offset from the centre c, d = c - eye, Z = d.forward + o.forward, and A = scale right -
/// (x(c) - middle) forward / ..., the vertex falls at x(c) + (A.o) / Z: numerator and quotient are of the cluster's
/// size, not the screen's, and that is what makes float enough. docs/method.md derives how far off it may be:
///   Z           rho = 8u (Zc + r) / Zmin, relative, r the cluster's radius and u = 2^-24
///   x, y        u (R (8.5 + 8.8 (Zc + r) / Zmin) + 3) pixels, R = |A| r / Zmin its radius in pixels, and what double
///               precision adds to the centre
/// Edge functions, over a box of width + height + 2 = S pixels: error = S (2.1 delta + 5u S), delta that of the
/// vertices; a triangle with less than four times that as twice its area goes the homogeneous way. Depth is linear on
/// the screen: error_depth = 8 range error / |twice area| + 8 (rho + 2u) largest. It holds with and without fused
/// operations.
class ClusterDraw {
 public:
  ClusterDraw(const Scene& scene, const Clusters& clusters, const Screen& screen, ClusterScratch& scratch,
              DepthTile& tile)
      : scene_(scene), clusters_(clusters), screen_(screen), scratch_(scratch), tile_(tile) {}

  /// `box`: pixels of the picture that the cluster may touch in the tile.
  void draw(const Cluster& cluster, PixelBox box) {
    cluster_ = &cluster;
    triangles_ = clusters_.triangles(cluster);
    if (!project_vertices(box)) return;
    const int count = gather_triangles(box);
    for (int first = 0; first < count; first += kLanes) set_up(first, count);
    flush();
  }

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

    box.x0 = std::max(box.x0, base_x_ + static_cast<int>(std::ceil(smallest(least_x) - error_.pixels)));
    box.y0 = std::max(box.y0, base_y_ + static_cast<int>(std::ceil(smallest(least_y) - error_.pixels)));
    box.x1 = std::min(box.x1, base_x_ + static_cast<int>(std::floor(largest(most_x) + error_.pixels)));
    box.y1 = std::min(box.y1, base_y_ + static_cast<int>(std::floor(largest(most_y) + error_.pixels)));
    if (box.x0 > box.x1 || box.y0 > box.y1) return false;
    const PixelBox in_tile{box.x0 - tile_.x_px, box.y0 - tile_.y_px, box.x1 - tile_.x_px, box.y1 - tile_.y_px};
    return !hides(tile_, in_tile, static_cast<float>(screen_.unit / nearest * (1 + 1e-6)));
  }

  /// Keeps the triangles whose box holds a pixel of `box`; returns how many.
  int gather_triangles(const PixelBox& box) {
    const Floats left = all(static_cast<float>(box.x0 - base_x_)), right = all(static_cast<float>(box.x1 - base_x_));
    const Floats top = all(static_cast<float>(box.y0 - base_y_)), bottom = all(static_cast<float>(box.y1 - base_y_));
    const Floats error = all(error_.pixels);
    const VertexTable table_x(scratch_.x), table_y(scratch_.y);
    const uint32_t* const corners = clusters_.corners(*cluster_);
    ClusterScratch& s = scratch_;
    int count = 0;
    for (int first = 0; first < cluster_->triangle_count; first += kLanes) {
      const Ints packed = load_int(corners + first);
      const Ints number[3] = {packed, hn::ShiftRight<8>(packed), hn::ShiftRight<16>(packed)};
      Floats x[3], y[3];
      for (int k = 0; k < 3; ++k) x[k] = table_x[number[k]], y[k] = table_y[number[k]];
      const Floats x0 = hn::Max(hn::Ceil(hn::Min(hn::Min(x[0], x[1]), x[2]) - error), left);
      const Floats x1 = hn::Min(hn::Floor(hn::Max(hn::Max(x[0], x[1]), x[2]) + error), right);
      const Floats y0 = hn::Max(hn::Ceil(hn::Min(hn::Min(y[0], y[1]), y[2]) - error), top);
      const Floats y1 = hn::Min(hn::Floor(hn::Max(hn::Max(y[0], y[1]), y[2]) + error), bottom);
      const Mask kept = hn::And(hn::And(hn::Le(x0, x1), hn::Le(y0, y1)), first_lanes(cluster_->triangle_count - first));
      const uint32_t bits = bits_of(kept);
      if (bits == 0) continue;
      for (int k = 0; k < 3; ++k)
        store(s.corner_x[k] + count, chosen(kept, x[k])), store(s.corner_y[k] + count, chosen(kept, y[k]));
      store(s.box_x0 + count, chosen(kept, x0)), store(s.box_x1 + count, chosen(kept, x1));
      store(s.box_y0 + count, chosen(kept, y0)), store(s.box_y1 + count, chosen(kept, y1));
      store_int(s.corners + count, chosen(kept, packed));
      count += __builtin_popcount(bits);
    }
    return count;
  }

  /// Triangles ready to be sampled, one a lane; see EdgeTriangle.
  struct LaneTriangles {
    Floats edge[3], dx[3], dy[3], error;
    Floats depth, depth_dx, depth_dy, depth_error, nearest;
    Floats box_x0, box_x1, box_y0, box_y1;
    Ints number;  ///< in the cluster
  };

  void set_up(int first, int count) {
    const ClusterScratch& s = scratch_;
    const Mask live = first_lanes(count - first);
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
    const Floats size = (width + height) + all(2);
    t.error = size * sum_of(size, all(5 * kU), all(2.1f * error_.pixels));
    const Mask sliver = hn::And(live, hn::Lt(area, t.error * all(4)));
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

    const Mask small =
        hn::And(hn::Lt(t.box_x1 - t.box_x0, all(kSmall_px - 0.5f)), hn::Lt(t.box_y1 - t.box_y0, all(kSmall_px - 0.5f)));
    if (scratch_.sample_count > ClusterScratch::kFullAt) flush();
    sample_small(t, hn::AndNot(sliver, hn::And(live, small)));
    sample_others(t, bits_of(hn::AndNot(sliver, hn::AndNot(small, live))));
    draw_slivers(t, bits_of(sliver));
  }

  /// Puts the samples of `sure` behind the others that wait. `hi` etc.: one a lane.
  void keep_samples(Mask sure, Floats depth, Floats error, Ints place, Ints number) {
    ClusterScratch& s = scratch_;
    store(s.lo + s.sample_count, chosen(sure, depth - error)),
        store(s.hi + s.sample_count, chosen(sure, depth + error));
    store_int(s.place + s.sample_count, chosen(sure, place)),
        store_int(s.number + s.sample_count, chosen(sure, number));
    s.sample_count += __builtin_popcount(bits_of(sure));
  }

  void queue_samples(uint32_t bits, Floats nearest, Ints place, Ints number) {
    HWY_ALIGN float nearest_of[kLongestVector];
    HWY_ALIGN int32_t place_of[kLongestVector], number_of[kLongestVector];
    store(nearest_of, nearest), store_int(place_of, place), store_int(number_of, number);
    for (; bits != 0; bits &= bits - 1) {
      const int i = __builtin_ctz(bits);
      queue(tile_, static_cast<uint32_t>(place_of[i]), triangles_[number_of[i]], nearest_of[i]);
    }
  }

  /// A triangle a lane: all pixels of all boxes, row after row.
  void sample_small(const LaneTriangles& t, Mask small) {
    if (hn::AllFalse(kFloats, small)) return;
    const Ints corner = (hn::ConvertTo(kInts, t.box_y0) + all_int(base_y_ - tile_.y_px)) * all_int(kTileStride) +
                        (hn::ConvertTo(kInts, t.box_x0) + all_int(base_x_ - tile_.x_px));
    const Floats outside = hn::Neg(t.error);
    for (int y = 0; y < kSmall_px; ++y) {
      const Floats dy = all(static_cast<float>(y));
      const Mask in_rows = hn::And(small, hn::Le(t.box_y0 + dy, t.box_y1));
      if (hn::AllFalse(kFloats, in_rows)) return;
      const Floats row[3] = {sum_of(t.dy[0], dy, t.edge[0]), sum_of(t.dy[1], dy, t.edge[1]),
                             sum_of(t.dy[2], dy, t.edge[2])};
      const Floats row_depth = sum_of(t.depth_dy, dy, t.depth);
      for (int x = 0; x < kSmall_px; ++x) {
        const Floats dx = all(static_cast<float>(x));
        const Mask in_box = hn::And(in_rows, hn::Le(t.box_x0 + dx, t.box_x1));
        const Floats least =
            hn::Min(hn::Min(sum_of(t.dx[0], dx, row[0]), sum_of(t.dx[1], dx, row[1])), sum_of(t.dx[2], dx, row[2]));
        const Mask may = hn::And(in_box, hn::Gt(least, outside));
        if (hn::AllFalse(kFloats, may)) {
          if (hn::AllFalse(kFloats, in_box)) break;
          continue;
        }
        const Mask sure = hn::And(may, hn::Gt(least, t.error));
        const Floats depth = sum_of(t.depth_dx, dx, row_depth);
        const Ints place = corner + all_int(y * kTileStride + x);
        keep_samples(sure, depth, t.depth_error, place, t.number);
        if (const uint32_t unsure = bits_of(hn::AndNot(sure, may)))
          queue_samples(unsure, hn::Min(depth + t.depth_error, t.nearest), place, t.number);
      }
    }
  }

  /// The triangles of `bits` one after the other.
  void sample_others(const LaneTriangles& t, uint32_t bits) {
    if (bits == 0) return;
    HWY_ALIGN float edge[3][kLongestVector], dx[3][kLongestVector], dy[3][kLongestVector], x_per_dx[3][kLongestVector];
    HWY_ALIGN float error[kLongestVector], depth[kLongestVector], depth_dx[kLongestVector], depth_dy[kLongestVector];
    HWY_ALIGN float depth_error[kLongestVector], nearest[kLongestVector], box[4][kLongestVector];
    HWY_ALIGN int32_t number[kLongestVector];
    for (int k = 0; k < 3; ++k) {
      store(edge[k], t.edge[k]), store(dx[k], t.dx[k]), store(dy[k], t.dy[k]);
      store(x_per_dx[k], all(-1) / t.dx[k]);
    }
    store(error, t.error), store(depth, t.depth), store(depth_dx, t.depth_dx), store(depth_dy, t.depth_dy);
    store(depth_error, t.depth_error), store(nearest, t.nearest), store_int(number, t.number);
    store(box[0], t.box_x0), store(box[1], t.box_y0), store(box[2], t.box_x1), store(box[3], t.box_y1);
    const int to_tile_x = base_x_ - tile_.x_px, to_tile_y = base_y_ - tile_.y_px;
    for (; bits != 0; bits &= bits - 1) {
      const int i = __builtin_ctz(bits);
      EdgeTriangle one;
      for (int k = 0; k < 3; ++k) {
        one.edge[k] = edge[k][i], one.dx[k] = dx[k][i], one.dy[k] = dy[k][i], one.error[k] = error[i];
        one.x_per_dx[k] = x_per_dx[k][i];
      }
      one.depth = depth[i], one.depth_dx = depth_dx[i], one.depth_dy = depth_dy[i], one.depth_error = depth_error[i];
      one.nearest = nearest[i];
      one.box = {static_cast<int>(box[0][i]) + to_tile_x, static_cast<int>(box[1][i]) + to_tile_y,
                 static_cast<int>(box[2][i]) + to_tile_x, static_cast<int>(box[3][i]) + to_tile_y};
      one.triangle = triangles_[number[i]], one.has_holes = cluster_->has_holes;
      if (one.box.x1 - one.box.x0 < kNarrow_px)
        sample_narrow(one, number[i]);
      else
        sample_triangle(tile_, one);
    }
  }

  /// A row a lane.
  void sample_narrow(const EdgeTriangle& t, int number) {
    if (scratch_.sample_count > ClusterScratch::kFullAt) flush();
    for (int y = t.box.y0; y <= t.box.y1; y += kLanes) {
      const Floats dy = lane_numbers() + all(static_cast<float>(y - t.box.y0));
      const Spans s = spans_of_rows(t, dy);
      const Floats row_depth = sum_of(all(t.depth_dy), dy, all(t.depth));
      Floats x = s.may_first;
      Ints place =
          (hn::Iota(kInts, 0) + all_int(y)) * all_int(kTileStride) + (hn::ConvertTo(kInts, x) + all_int(t.box.x0));
      for (Mask may = hn::Le(x, s.may_last); !hn::AllFalse(kFloats, may); may = hn::Le(x, s.may_last)) {
        const Mask sure = hn::And(may, hn::And(hn::Le(s.sure_first, x), hn::Le(x, s.sure_last)));
        const Floats depth = sum_of(all(t.depth_dx), x, row_depth), error = all(t.depth_error);
        keep_samples(sure, depth, error, place, all_int(number));
        if (const uint32_t unsure = bits_of(hn::AndNot(sure, may)))
          queue_samples(unsure, hn::Min(depth + error, all(t.nearest)), place, all_int(number));
        x = x + all(1), place = place + all_int(1);
      }
    }
  }

  void draw_slivers(const LaneTriangles& t, uint32_t bits) {
    if (bits == 0) return;
    HWY_ALIGN float nearest[kLongestVector], box[4][kLongestVector];
    HWY_ALIGN int32_t number[kLongestVector];
    store(nearest, t.nearest), store_int(number, t.number);
    store(box[0], t.box_x0), store(box[1], t.box_y0), store(box[2], t.box_x1), store(box[3], t.box_y1);
    for (; bits != 0; bits &= bits - 1) {
      const int i = __builtin_ctz(bits);
      draw_homogeneous(tile_, make_homogeneous(scene_, screen_, triangles_[number[i]], nearest[i]),
                       {static_cast<int>(box[0][i]) + base_x_, static_cast<int>(box[1][i]) + base_y_,
                        static_cast<int>(box[2][i]) + base_x_, static_cast<int>(box[3][i]) + base_y_});
    }
  }

  /// Compares the samples that wait with the tile. Where there are holes none is sure before its look-up.
  void flush() {
    const ClusterScratch& s = scratch_;
    const uint32_t* const triangles = triangles_;
    const bool has_holes = cluster_->has_holes;
    const int count = s.sample_count;
    for (int i = 0; i < count; ++i) {
      const uint32_t place = s.place[i];
      if (s.hi[i] < tile_.lo[place]) continue;
      const uint32_t triangle = triangles[s.number[i]];
      if (s.lo[i] > tile_.hi[place] && !has_holes)
        tile_.lo[place] = s.lo[i], tile_.hi[place] = s.hi[i], tile_.triangle[place] = triangle;
      else
        queue(tile_, place, triangle, s.hi[i]);
    }
    scratch_.sample_count = 0;
  }

  const Scene& scene_;
  const Clusters& clusters_;
  const Screen& screen_;
  ClusterScratch& scratch_;
  DepthTile& tile_;

  // The cluster at hand. Its vertices count pixels of the picture from (base_x_, base_y_).
  const Cluster* cluster_ = nullptr;
  const uint32_t* triangles_ = nullptr;
  int base_x_ = 0, base_y_ = 0;
  VertexError error_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
