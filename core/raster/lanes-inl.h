// Compiled once for every vector instruction set that includes it, hence the toggle instead of a #pragma once.
#if defined(HYBRIDRT_RASTER_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_LANES_H
#undef HYBRIDRT_RASTER_LANES_H
#else
#define HYBRIDRT_RASTER_LANES_H
#endif

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <hwy/highway.h>

#include "core/raster/chosen_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The rasteriser's vectors: as many floats as the instruction set holds, at most 16, and as many integers. Their
// arithmetic is written with operators; sum_of() may be fused. No bound on an error counts on either.
using FloatLanes = hn::CappedTag<float, 16>;
using IntLanes = hn::RebindToSigned<FloatLanes>;
constexpr FloatLanes kFloats;
constexpr IntLanes kInts;
using Floats = hn::Vec<FloatLanes>;
using Ints = hn::Vec<IntLanes>;
using Mask = hn::Mask<FloatLanes>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kFloats));

HWY_INLINE Floats all(float x) { return hn::Set(kFloats, x); }
HWY_INLINE Ints all_int(int x) { return hn::Set(kInts, x); }
HWY_INLINE Floats load(const float* p) { return hn::LoadU(kFloats, p); }
HWY_INLINE void store(float* p, Floats v) { hn::StoreU(v, kFloats, p); }
HWY_INLINE Ints load_int(const uint32_t* p) { return hn::LoadU(kInts, reinterpret_cast<const int32_t*>(p)); }
HWY_INLINE void store_int(uint32_t* p, Ints v) { hn::StoreU(v, kInts, reinterpret_cast<int32_t*>(p)); }
HWY_INLINE void store_int(int32_t* p, Ints v) { hn::StoreU(v, kInts, p); }

/// a b + c
HWY_INLINE Floats sum_of(Floats a, Floats b, Floats c) { return hn::MulAdd(a, b, c); }

/// 0, 1, 2, ...
HWY_INLINE Floats lane_numbers() { return hn::Iota(kFloats, 0); }

HWY_INLINE Mask first_lanes(int count) {
  return hn::FirstN(kFloats, static_cast<size_t>(std::clamp(count, 0, kLanes)));
}

/// Bit i is lane i.
HWY_INLINE uint32_t bits_of(Mask mask) {
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(kFloats, mask, bytes);
  uint32_t bits;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits;
}

/// The lanes that a mask chooses, moved to the front.
#if HWY_TARGET <= HWY_AVX3
class Chosen {
 public:
  explicit Chosen(Mask mask) : mask_(mask) {}
  Floats operator()(Floats v) const { return hn::Compress(v, mask_); }
  Ints operator()(Ints v) const { return hn::Compress(v, hn::RebindMask(kInts, mask_)); }

 private:
  Mask mask_;
};
#else
/// Highway's Compress has its table as a local constant, which GCC copies to the stack, 2 KiB, for each call.
class Chosen {
 public:
  explicit Chosen(Mask mask)
      : lanes_(hn::PromoteTo(kInts, hn::LoadU(hn::Rebind<uint8_t, IntLanes>(), kChosenLanes[bits_of(mask)].data()))) {}
  Floats operator()(Floats v) const { return hn::TableLookupLanes(v, hn::IndicesFromVec(kFloats, lanes_)); }
  Ints operator()(Ints v) const { return hn::TableLookupLanes(v, hn::IndicesFromVec(kInts, lanes_)); }

 private:
  Ints lanes_;
};
#endif

HWY_INLINE float smallest(Floats v) { return hn::GetLane(hn::MinOfLanes(kFloats, v)); }
HWY_INLINE float largest(Floats v) { return hn::GetLane(hn::MaxOfLanes(kFloats, v)); }

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
