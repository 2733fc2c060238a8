#include "core/trace/kd_split.h"

#include <algorithm>
#include <array>
#include <vector>

namespace hybridrt {
namespace {

// Measured: a test of four triangles costs about as much as a step down, whose branch is hard to predict.
constexpr float kStepCost = 1.0f;
constexpr float kLeafCost = 1.0f;       // entering a leaf at all
constexpr float kFourTestsCost = 0.6f;  // four triangle tests at once
constexpr float kEmptyBonus = 0.9f;     // factor for planes that cut off empty space
constexpr int kBins = 64;
constexpr size_t kSweepMax = 48;  // references; up to here all planes are tried
constexpr size_t kBinGrain = 1 << 15;

// In double: the product of two extents may overflow or underflow in float.
double half_area(const dvec3& extent) { return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x; }

/// Collects the best of the planes offered to it.
class BestSplit {
 public:
  explicit BestSplit(const Aabb& box) : box_(box), extent_(dvec3(box.hi) - dvec3(box.lo)), area_(half_area(extent_)) {}

  /// A plane with `left` and `right` references beside it and `planar` in it.
  void offer(int axis, float position, size_t left, size_t planar, size_t right) {
    // A plane on the cell's own face makes sense only if it peels flat triangles off.
    const bool at_lo = position <= box_.lo[axis], at_hi = position >= box_.hi[axis];
    if (planar > 0 || !(at_lo || at_hi)) {
      if (!at_hi) offer_side(axis, position, left + planar, right, true);
      if (!at_lo && planar > 0) offer_side(axis, position, left, right + planar, false);
    }
  }

  std::optional<KdSplit> best() const { return best_; }

 private:
  void offer_side(int axis, float position, size_t left, size_t right, bool planar_left) {
    dvec3 left_extent = extent_, right_extent = extent_;
    left_extent[axis] = std::max(0.0, double(position) - box_.lo[axis]);
    right_extent[axis] = std::max(0.0, double(box_.hi[axis]) - position);
    const float p_left = static_cast<float>(half_area(left_extent) / area_);
    const float p_right = static_cast<float>(half_area(right_extent) / area_);
    float cost = p_left * kd_leaf_cost(left) + p_right * kd_leaf_cost(right);
    if (left == 0 || right == 0) cost *= kEmptyBonus;
    cost += kStepCost;
    if (cost < (best_ ? best_->cost : std::numeric_limits<float>::infinity()))  // false for NaN: flat cells
      best_ = KdSplit{position, axis, planar_left, cost};
  }

  const Aabb& box_;
  dvec3 extent_;
  double area_;
  std::optional<KdSplit> best_;
};

/// Exact: every side of every reference's box, by a sweep over the sorted sides.
void sweep(std::span<const KdReference> refs, int axis, BestSplit& best) {
  std::array<float, kSweepMax> starts, ends, flats;
  const size_t count = refs.size();
  size_t flat_count = 0;
  for (size_t i = 0; i < count; ++i) {
    starts[i] = refs[i].box.lo[axis];
    ends[i] = refs[i].box.hi[axis];
    if (starts[i] == ends[i]) flats[flat_count++] = starts[i];
  }
  std::sort(starts.begin(), starts.begin() + count);
  std::sort(ends.begin(), ends.begin() + count);
  std::sort(flats.begin(), flats.begin() + flat_count);

  size_t started = 0, ended = 0, flat = 0;  // references that start below, end at or below, lie in the plane
  while (ended < count) {
    const float position = started < count ? std::min(starts[started], ends[ended]) : ends[ended];
    size_t planar = 0;
    while (ended < count && ends[ended] == position) ++ended;
    while (flat < flat_count && flats[flat] == position) ++flat, ++planar;
    best.offer(axis, position, started, planar, count - ended);
    while (started < count && starts[started] == position) ++started;
  }
}

/// How many references start and end in each slab between two planes of a regular grid, on three axes.
struct Bins {
  std::array<std::array<uint32_t, kBins>, 3> starts{}, ends{};

  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis)
      for (int bin = 0; bin < kBins; ++bin) {
        starts[axis][bin] += other.starts[axis][bin];
        ends[axis][bin] += other.ends[axis][bin];
      }
  }
};

Aabb bounds_of(std::span<const KdReference> refs) {
  Aabb bounds;
  for (const KdReference& ref : refs) bounds.grow(ref.box);
  return bounds;
}

Bins count_bins(std::span<const KdReference> refs, const Aabb& bounds, const vec3& bins_per_unit) {
  Bins bins;
  const vec3 last(kBins - 1);
  for (const KdReference& ref : refs) {
    const uvec3 start(glm::min((ref.box.lo - bounds.lo) * bins_per_unit, last));
    const uvec3 end(glm::min((ref.box.hi - bounds.lo) * bins_per_unit, last));
    for (int axis = 0; axis < 3; ++axis) ++bins.starts[axis][start[axis]], ++bins.ends[axis][end[axis]];
  }
  return bins;
}

/// Calls `reduce(part, partial result)` in the order of the parts, so that threads do not affect the result.
template <typename Result, typename Map, typename Reduce>
void map_reduce(std::span<const KdReference> refs, ThreadPool* pool, const Map& map, const Reduce& reduce) {
  if (!pool || refs.size() <= kBinGrain) return reduce(map(refs));
  std::vector<Result> parts((refs.size() + kBinGrain - 1) / kBinGrain);
  parallel_for(*pool, refs.size(), kBinGrain,
               [&](size_t begin, size_t end) { parts[begin / kBinGrain] = map(refs.subspan(begin, end - begin)); });
  for (const Result& part : parts) reduce(part);
}

/// Approximate: the planes of a regular grid over the references' bounds (Hurley et al., "Fast ray tracing
/// for modern general purpose CPU", 2002; Shevtsov et al., "Highly parallel fast kd-tree construction",
/// 2007), and the two that cut off the empty space outside these bounds.
void bin(std::span<const KdReference> refs, const Aabb& box, ThreadPool* pool, BestSplit& best) {
  Aabb bounds;
  map_reduce<Aabb>(refs, pool, bounds_of, [&](const Aabb& part) { bounds.grow(part); });
  const vec3 extent = bounds.hi - bounds.lo;
  vec3 bins_per_unit(0);
  for (int axis = 0; axis < 3; ++axis)
    if (const float per_unit = kBins / extent[axis]; std::isfinite(per_unit)) bins_per_unit[axis] = per_unit;

  Bins bins;
  map_reduce<Bins>(
      refs, pool, [&](std::span<const KdReference> part) { return count_bins(part, bounds, bins_per_unit); },
      [&](const Bins& part) { bins.add(part); });

  for (int axis = 0; axis < 3; ++axis) {
    if (box.lo[axis] == box.hi[axis]) continue;
    if (extent[axis] == 0) {
      best.offer(axis, bounds.lo[axis], 0, refs.size(), 0);
      continue;
    }
    if (bounds.lo[axis] > box.lo[axis]) best.offer(axis, bounds.lo[axis], 0, 0, refs.size());
    if (bounds.hi[axis] < box.hi[axis]) best.offer(axis, bounds.hi[axis], refs.size(), 0, 0);
    if (bins_per_unit[axis] == 0) continue;
    size_t left = 0, right = refs.size();
    for (int plane = 1; plane < kBins; ++plane) {
      left += bins.starts[axis][plane - 1];
      right -= bins.ends[axis][plane - 1];
      const float position = bounds.lo[axis] + extent[axis] * (float(plane) / kBins);
      if (position > bounds.lo[axis] && position < bounds.hi[axis]) best.offer(axis, position, left, 0, right);
    }
  }
}

}  // namespace

float kd_leaf_cost(size_t references) {
  return references == 0 ? 0 : kLeafCost + kFourTestsCost * static_cast<float>((references + 3) / 4);
}

std::optional<KdSplit> find_kd_split(std::span<const KdReference> refs, const Aabb& box, ThreadPool* pool) {
  BestSplit best(box);
  if (refs.size() > kSweepMax) {
    bin(refs, box, pool, best);
  } else {
    for (int axis = 0; axis < 3; ++axis)
      if (box.lo[axis] < box.hi[axis]) sweep(refs, axis, best);
  }
  return best.best();
}

}  // namespace hybridrt
