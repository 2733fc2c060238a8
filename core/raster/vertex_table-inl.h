// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_VERTEX_TABLE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_VERTEX_TABLE_H
#undef HYBRIDRT_RASTER_VERTEX_TABLE_H
#else
#define HYBRIDRT_RASTER_VERTEX_TABLE_H
#endif

#include "core/raster/clusters.h"
#include "core/raster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// Looks up values of a cluster's vertices by the low six bits of each lane.
#if HWY_TARGET <= HWY_AVX3
/// They fit four registers, and two permutations are several times faster than a gather.
class VertexTable {
 public:
  explicit VertexTable(const float* values)
      : part_{load(values), load(values + 16), load(values + 32), load(values + 48)} {}
  Floats operator[](Ints number) const {
    const __m512 low = _mm512_permutex2var_ps(part_[0].raw, number.raw, part_[1].raw);
    const __m512 high = _mm512_permutex2var_ps(part_[2].raw, number.raw, part_[3].raw);
    return Floats{_mm512_mask_blend_ps(_mm512_test_epi32_mask(number.raw, _mm512_set1_epi32(32)), low, high)};
  }

 private:
  Floats part_[4];
};
#else
class VertexTable {
 public:
  explicit VertexTable(const float* values) : values_(values) {}
  Floats operator[](Ints number) const {
    return hn::GatherIndex(kFloats, values_, hn::And(number, all_int(kClusterVertices - 1)));
  }

 private:
  const float* values_;
};
#endif

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
