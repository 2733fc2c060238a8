#include "core/trace/leaf_simd.h"

#include "core/trace/holes.h"
#include "core/trace/triangle.h"

// clang-format off: the order matters
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/leaf_simd.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

#include "core/trace/kd_traverse.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::FixedTag<float, 4>;
using Floats = hn::Vec<Lanes>;
constexpr Lanes kLanes;

/// One corner of four triangles, relative to the ray's origin, axes in the order of the sheared ray.
struct Corners {
  Floats x, y, z;
};

/// intersect_triangle in four lanes: the same operations in the same order, so that it rounds the same. Lanes for which
/// that function falls back to double are passed to it.
class FourLeaf {
 public:
  FourLeaf(const KdTree& tree, const Ray<float>& ray)
      : ray_(shear_ray(ray.origin, ray.dir)),
        triangles_(tree.triangles.data()),
        ids_(tree.leaf_triangles.data()),
        holes_(tree.holes.get()),
        sx_(hn::Set(kLanes, ray_.sx)),
        sy_(hn::Set(kLanes, ray_.sy)),
        sz_(hn::Set(kLanes, ray_.sz)) {
    alignas(16) const float origin[4] = {ray.origin.x, ray.origin.y, ray.origin.z, 0};
    origin_ = hn::Load(kLanes, origin);
    alignas(16) const int32_t order[4] = {ray_.kx, ray_.ky, ray_.kz, 3};
    order_ = hn::SetTableIndices(kLanes, order);
  }

  template <bool kAny>
  void test(uint32_t first, uint32_t count, NearestHit<float>& nearest) const {
    const uint32_t last = first + count - 1;
    for (uint32_t i = first; i <= last; i += 4) {
      // A short last group repeats its last triangle, which changes nothing.
      const KdTriangle* four[4] = {&triangles_[ids_[i]], &triangles_[ids_[std::min(i + 1, last)]],
                                   &triangles_[ids_[std::min(i + 2, last)]], &triangles_[ids_[std::min(i + 3, last)]]};
      test_four<kAny>(four, nearest);
      if (kAny && nearest.found()) return;
    }
  }

 private:
  Floats load(const vec3& corner) const {
    return hn::TableLookupLanes(hn::Sub(hn::Load(kLanes, &corner.x), origin_), order_);
  }

  Corners transpose(Floats p0, Floats p1, Floats p2, Floats p3) const {
    const auto xy01 = hn::InterleaveLower(kLanes, p0, p1), zw01 = hn::InterleaveUpper(kLanes, p0, p1);
    const auto xy23 = hn::InterleaveLower(kLanes, p2, p3), zw23 = hn::InterleaveUpper(kLanes, p2, p3);
    return {hn::ConcatLowerLower(kLanes, xy23, xy01), hn::ConcatUpperUpper(kLanes, xy23, xy01),
            hn::ConcatLowerLower(kLanes, zw23, zw01)};
  }

  template <bool kAny>
  void test_four(const KdTriangle* const (&four)[4], NearestHit<float>& nearest) const {
    const Corners a = transpose(load(four[0]->a), load(four[1]->a), load(four[2]->a), load(four[3]->a));
    const Corners b = transpose(load(four[0]->b), load(four[1]->b), load(four[2]->b), load(four[3]->b));
    const Corners c = transpose(load(four[0]->c), load(four[1]->c), load(four[2]->c), load(four[3]->c));
    const auto ax = hn::Sub(a.x, hn::Mul(sx_, a.z)), ay = hn::Sub(a.y, hn::Mul(sy_, a.z));
    const auto bx = hn::Sub(b.x, hn::Mul(sx_, b.z)), by = hn::Sub(b.y, hn::Mul(sy_, b.z));
    const auto cx = hn::Sub(c.x, hn::Mul(sx_, c.z)), cy = hn::Sub(c.y, hn::Mul(sy_, c.z));
    const auto wa = hn::Sub(hn::Mul(cx, by), hn::Mul(cy, bx));
    const auto wb = hn::Sub(hn::Mul(ax, cy), hn::Mul(ay, cx));
    const auto wc = hn::Sub(hn::Mul(bx, ay), hn::Mul(by, ax));

    const auto zero = hn::Zero(kLanes);
    const auto some_negative = hn::Lt(hn::Min(wa, hn::Min(wb, wc)), zero);
    const auto some_positive = hn::Gt(hn::Max(wa, hn::Max(wb, wc)), zero);
    const auto outside = hn::And(some_negative, some_positive);
    if (hn::AllTrue(kLanes, outside)) return;

    const auto det = hn::Add(hn::Add(wa, wb), wc);
    const auto size = hn::Abs(det);
    const auto off_edges = hn::Gt(hn::Min(hn::Abs(wa), hn::Min(hn::Abs(wb), hn::Abs(wc))), zero);
    const auto in_range =
        hn::And(hn::Ge(size, hn::Set(kLanes, kSmallestFloatDet)), hn::Le(size, hn::Set(kLanes, kLargestFloatDet)));
    const auto in_float = hn::And(off_edges, in_range);

    const auto per_det = hn::Div(hn::Set(kLanes, 1.0f), det);
    const auto w = hn::Mul(wa, per_det), u = hn::Mul(wb, per_det), v = hn::Mul(wc, per_det);
    const auto distance = hn::Add(hn::Add(hn::Mul(w, a.z), hn::Mul(u, b.z)), hn::Mul(v, c.z));
    const auto t = hn::Mul(distance, sz_);
    const auto in_reach = hn::And(hn::Gt(t, hn::Set(kLanes, nearest.t_min)), hn::Le(t, hn::Set(kLanes, nearest.t)));

    const auto in_double = hn::AndNot(outside, hn::Not(in_float));
    const auto hit = hn::AndNot(outside, hn::And(in_float, in_reach));
    if (hn::AllFalse(kLanes, hn::Or(hit, in_double))) return;

    alignas(16) float ts[4], weights[3][4], areas[4];
    hn::Store(t, kLanes, ts), hn::Store(det, kLanes, areas);
    hn::Store(w, kLanes, weights[0]), hn::Store(u, kLanes, weights[1]), hn::Store(v, kLanes, weights[2]);
    uint8_t hit_bits[8] = {}, double_bits[8] = {};
    hn::StoreMaskBits(kLanes, hit, hit_bits), hn::StoreMaskBits(kLanes, in_double, double_bits);
    for (int lane = 0; lane < 4; ++lane) {
      const KdTriangle& triangle = *four[lane];
      TriangleHit<float> found{ts[lane], weights[triangle.second][lane], weights[triangle.third][lane],
                               met_from_front(ray_.sz, areas[lane], triangle.turned)};
      const bool accept = (hit_bits[0] >> lane & 1) ||
                          ((double_bits[0] >> lane & 1) && intersect_triangle(ray_, ordered(triangle), found));
      if (!accept || (holes_ && is_hole(*holes_, triangle.id, found.u, found.v))) continue;
      nearest.offer(found, triangle.id);
    }
  }

  ShearedRay<float> ray_;
  const KdTriangle* triangles_;
  const uint32_t* ids_;
  const Textures* holes_;
  Floats origin_, sx_, sy_, sz_;
  decltype(hn::SetTableIndices(kLanes, static_cast<const int32_t*>(nullptr))) order_;
};

void closest_hits(const KdTree& tree, const Ray<float>* rays, size_t count, Hit<float>* hits) {
  for (size_t i = 0; i < count; ++i) hits[i] = traverse<false, FourLeaf>(tree, rays[i]);
}

void any_hits(const KdTree& tree, const Ray<float>* rays, size_t count, uint8_t* occluded) {
  for (size_t i = 0; i < count; ++i) occluded[i] = traverse<true, FourLeaf>(tree, rays[i]).found();
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hybridrt {

HWY_EXPORT(closest_hits);
HWY_EXPORT(any_hits);

void closest_hits_simd(const KdTree& tree, std::span<const Ray<float>> rays, std::span<Hit<float>> hits) {
  HWY_DYNAMIC_DISPATCH(closest_hits)(tree, rays.data(), rays.size(), hits.data());
}

void any_hits_simd(const KdTree& tree, std::span<const Ray<float>> rays, std::span<uint8_t> occluded) {
  HWY_DYNAMIC_DISPATCH(any_hits)(tree, rays.data(), rays.size(), occluded.data());
}

}  // namespace hybridrt
#endif  // HWY_ONCE
