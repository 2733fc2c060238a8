// Compiled once for every vector instruction set that includes it, hence the toggle instead of a #pragma once.
#if defined(HYBRIDRT_TEXTURE_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_TEXTURE_LANES_H
#undef HYBRIDRT_TEXTURE_LANES_H
#else
#define HYBRIDRT_TEXTURE_LANES_H
#endif

#include "core/trace/surface_lanes-inl.h"
#include "shaders/shared.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

// shaders/texture.glsl compiled for vectors of floats, one pixel a lane, all of the same material: texels are gathered.
// A lane gives the same bits as TextureLookup<float>.

/// Whole numbers, one a lane. T: int32_t or uint32_t.
template <typename T>
struct LaneInteger {
  using Lanes = hn::Rebind<T, LanesOf<float>>;
  using Mask = hn::Mask<Lanes>;
  hn::Vec<Lanes> v;

  explicit LaneInteger(hn::Vec<Lanes> value) : v(value) {}
  explicit LaneInteger(T all) : v(hn::Set(Lanes(), all)) {}
  explicit LaneInteger(LaneReal<float> real) : v(hn::ConvertTo(Lanes(), real.v)) {}  // toward zero
  template <typename Other>
  explicit LaneInteger(LaneInteger<Other> other) : v(hn::BitCast(Lanes(), other.v)) {}
  explicit operator LaneReal<float>() const { return LaneReal<float>(hn::ConvertTo(LanesOf<float>(), v)); }

  LaneInteger operator+(LaneInteger o) const { return LaneInteger(hn::Add(v, o.v)); }
  LaneInteger operator-(LaneInteger o) const { return LaneInteger(hn::Sub(v, o.v)); }
  LaneInteger operator*(LaneInteger o) const { return LaneInteger(hn::Mul(v, o.v)); }
  LaneInteger operator&(LaneInteger o) const { return LaneInteger(hn::And(v, o.v)); }
  LaneInteger operator>>(int bits) const { return LaneInteger(hn::ShiftRightSame(v, bits)); }
  Mask operator<(LaneInteger o) const { return hn::Lt(v, o.v); }
};

/// `mask` may be that of a comparison of floats.
template <typename Mask, typename T>
LaneInteger<T> choose(Mask mask, LaneInteger<T> a, LaneInteger<T> b) {
  using Lanes = typename LaneInteger<T>::Lanes;
  return LaneInteger<T>(hn::IfThenElse(hn::RebindMask(Lanes(), mask), a.v, b.v));
}
template <typename T>
LaneInteger<T> max(LaneInteger<T> a, LaneInteger<T> b) {
  return LaneInteger<T>(hn::Max(a.v, b.v));
}

struct LaneVec2 {
  LaneReal<float> x, y;
  explicit LaneVec2(LaneReal<float> all) : x(all), y(all) {}
  LaneVec2(LaneReal<float> x_, LaneReal<float> y_) : x(x_), y(y_) {}
  LaneVec2 operator+(LaneVec2 o) const { return {x + o.x, y + o.y}; }
  LaneVec2 operator-(LaneVec2 o) const { return {x - o.x, y - o.y}; }
  LaneVec2 operator*(LaneVec2 o) const { return {x * o.x, y * o.y}; }
};
inline LaneVec2 operator*(LaneReal<float> s, LaneVec2 v) { return {s * v.x, s * v.y}; }

inline LaneReal<float> floor(LaneReal<float> a) { return LaneReal<float>(hn::Floor(a.v)); }
inline LaneVec2 floor(LaneVec2 a) { return {floor(a.x), floor(a.y)}; }
inline LaneReal<float> clamp(LaneReal<float> a, LaneReal<float> least, LaneReal<float> most) {
  return min(max(a, least), most);
}
inline LaneVec2 clamp(LaneVec2 a, LaneVec2 least, LaneVec2 most) {
  return {clamp(a.x, least.x, most.x), clamp(a.y, least.y, most.y)};
}
inline LaneVec3<float> max(LaneVec3<float> a, LaneVec3<float> b) {
  return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}
inline LaneVec3<float> mix(LaneVec3<float> a, LaneVec3<float> b, LaneReal<float> share) {
  return (LaneReal<float>(1) - share) * a + share * b;
}

#define HRT_FN
#define HRT_CHOOSE(condition, a, b) choose(condition, a, b)
#define HRT_ANY(condition) any(condition)
struct TextureLanes {
  using Real = LaneReal<float>;
  using Vec2 = LaneVec2;
  using Vec3 = LaneVec3<float>;
  using Int = LaneInteger<int32_t>;
  using Uint = LaneInteger<uint32_t>;
  using uint = uint32_t;
  const uint32_t* words;

  uint32_t texture_word(uint32_t i) const { return words[i]; }
  Uint texel_word(Uint i) const { return Uint(hn::GatherIndex(Uint::Lanes(), words, hn::BitCast(Int::Lanes(), i.v))); }
  static float uintBitsToFloat(uint32_t bits) { return glm::uintBitsToFloat(bits); }
  static Real uintBitsToFloat(Uint bits) { return Real(hn::BitCast(LanesOf<float>(), bits.v)); }
#include "shaders/texture.glsl"
};
#undef HRT_FN
#undef HRT_CHOOSE
#undef HRT_ANY

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
