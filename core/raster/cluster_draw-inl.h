// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_CLUSTER_DRAW_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_CLUSTER_DRAW_H
#undef HYBRIDRT_RASTER_CLUSTER_DRAW_H
#else
#define HYBRIDRT_RASTER_CLUSTER_DRAW_H
#endif

#include "core/raster/cluster_triangles-inl.h"
#include "core/raster/spans-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// Draws clusters into one tile, which is sampled at the centres of its pixels.
class ClusterDraw {
 public:
  ClusterDraw(const Scene& scene, const Clusters& clusters, const Screen& screen, ClusterScratch& scratch,
              DepthTile& tile)
      : screen_(screen),
        scene_(scene),
        scratch_(scratch),
        tile_(tile),
        triangles_(scene, clusters, screen, scratch, tile) {}

  /// `box`: pixels of the picture that the cluster may touch in the tile.
  void draw(const Cluster& cluster, const PixelBox& box) {
    const int count = triangles_.begin(cluster, box);
    for (int first = 0; first < count; first += kLanes) sample(first, first_lanes(count - first));
    flush();
  }
  void draw(const HomogeneousTriangle& triangle, const PixelBox& box) { draw_homogeneous(tile_, triangle, box); }

  void settle() { hybridrt::settle(scene_, screen_, tile_); }

 private:
  void sample(int first, Mask live) {
    Mask sliver;
    const LaneTriangles t = triangles_.set_up(first, live, sliver);
    const Mask small =
        hn::And(hn::Lt(t.box_x1 - t.box_x0, all(kSmall_px - 0.5f)), hn::Lt(t.box_y1 - t.box_y0, all(kSmall_px - 0.5f)));
    if (scratch_.sample_count > ClusterScratch::kFullAt) flush();
    sample_small(t, hn::AndNot(sliver, hn::And(live, small)));
    sample_others(t, bits_of(hn::AndNot(sliver, hn::AndNot(small, live))));
    triangles_.for_each_sliver(t, bits_of(sliver), [&](const HomogeneousTriangle& one, const PixelBox& box) {
      draw_homogeneous(tile_, one, box);
    });
  }

  /// Puts the samples of `sure` behind the others that wait. `hi` etc.: one a lane.
  void keep_samples(Mask sure, Floats depth, Floats error, Ints place, Ints number) {
    ClusterScratch& s = scratch_;
    const Chosen chosen(sure);
    store(s.lo + s.sample_count, chosen(depth - error)), store(s.hi + s.sample_count, chosen(depth + error));
    store_int(s.place + s.sample_count, chosen(place)), store_int(s.number + s.sample_count, chosen(number));
    s.sample_count += __builtin_popcount(bits_of(sure));
  }

  void queue_samples(uint32_t bits, Floats nearest, Ints place, Ints number) {
    HWY_ALIGN float nearest_of[kLongestVector];
    HWY_ALIGN int32_t place_of[kLongestVector], number_of[kLongestVector];
    store(nearest_of, nearest), store_int(place_of, place), store_int(number_of, number);
    for (; bits != 0; bits &= bits - 1) {
      const int i = __builtin_ctz(bits);
      queue(tile_, static_cast<uint32_t>(place_of[i]), triangles_.indices()[number_of[i]], nearest_of[i]);
    }
  }

  /// A triangle a lane: all pixels of all boxes, row after row.
  void sample_small(const LaneTriangles& t, Mask small) {
    if (hn::AllFalse(kFloats, small)) return;
    const Ints corner = (hn::ConvertTo(kInts, t.box_y0) + all_int(triangles_.to_tile_y())) * all_int(kTileStride) +
                        (hn::ConvertTo(kInts, t.box_x0) + all_int(triangles_.to_tile_x()));
    const Floats outside = hn::Neg(t.error);
    const std::optional<HoleLanes> holes = triangles_.holes();
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
        Mask may = hn::And(in_box, hn::Gt(least, outside));
        if (hn::AllFalse(kFloats, may)) {
          if (hn::AllFalse(kFloats, in_box)) break;
          continue;
        }
        Mask sure = hn::And(may, hn::Gt(least, t.error));
        const Floats depth = sum_of(t.depth_dx, dx, row_depth);
        if (holes) holes->decide(dx, dy, depth, sure, may);
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
    const StoredTriangles stored(t);
    for (; bits != 0; bits &= bits - 1) {
      const int i = __builtin_ctz(bits);
      const EdgeTriangle one = triangles_.edges_of(stored, i);
      const std::optional<HoleLanes> holes = triangles_.holes_of(i);
      if (one.box.x1 - one.box.x0 < kNarrow_px)
        sample_narrow(one, holes, stored.number[i]);
      else
        sample_triangle(tile_, one, holes);
    }
  }

  /// A row a lane.
  void sample_narrow(const EdgeTriangle& t, const std::optional<HoleLanes>& holes, int number) {
    if (scratch_.sample_count > ClusterScratch::kFullAt) flush();
    for (int y = t.box.y0; y <= t.box.y1; y += kLanes) {
      const Floats dy = lane_numbers() + all(static_cast<float>(y - t.box.y0));
      const Spans s = spans_of_rows(t, dy);
      const Floats row_depth = sum_of(all(t.depth_dy), dy, all(t.depth));
      Floats x = s.may_first;
      Ints place =
          (hn::Iota(kInts, 0) + all_int(y)) * all_int(kTileStride) + (hn::ConvertTo(kInts, x) + all_int(t.box.x0));
      for (Mask may = hn::Le(x, s.may_last); !hn::AllFalse(kFloats, may); may = hn::Le(x, s.may_last)) {
        Mask sure = hn::And(may, hn::And(hn::Le(s.sure_first, x), hn::Le(x, s.sure_last)));
        const Floats depth = sum_of(all(t.depth_dx), x, row_depth), error = all(t.depth_error);
        if (holes) holes->decide(x, dy, depth, sure, may);
        keep_samples(sure, depth, error, place, all_int(number));
        if (const uint32_t unsure = bits_of(hn::AndNot(sure, may)))
          queue_samples(unsure, hn::Min(depth + error, all(t.nearest)), place, all_int(number));
        x = x + all(1), place = place + all_int(1);
      }
    }
  }

  /// Compares the samples that wait with the tile.
  void flush() {
    const ClusterScratch& s = scratch_;
    const uint32_t* const triangles = triangles_.indices();
    const int count = s.sample_count;
    for (int i = 0; i < count; ++i) {
      const uint32_t place = s.place[i];
      if (s.hi[i] < tile_.lo[place]) continue;
      const uint32_t triangle = triangles[s.number[i]];
      if (s.lo[i] > tile_.hi[place])
        tile_.lo[place] = s.lo[i], tile_.hi[place] = s.hi[i], tile_.triangle[place] = triangle;
      else
        queue(tile_, place, triangle, s.hi[i]);
    }
    scratch_.sample_count = 0;
  }

  const Screen& screen_;
  const Scene& scene_;
  ClusterScratch& scratch_;
  DepthTile& tile_;
  ClusterTriangles triangles_;
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
