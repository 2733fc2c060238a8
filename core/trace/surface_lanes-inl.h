// Compiled once for every vector instruction set that includes it, hence the toggle instead of a #pragma once.
#if defined(HYBRIDRT_SURFACE_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_SURFACE_LANES_H
#undef HYBRIDRT_SURFACE_LANES_H
#else
#define HYBRIDRT_SURFACE_LANES_H
#endif

#include <cmath>
#include <hwy/highway.h>

#include "core/base/math.h"
#include "core/trace/log2.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// shaders/surface.glsl compiled for vectors of numbers, one pixel a lane: 16 floats or 8 doubles at most. Every
// operation rounds as it does on single numbers, in the order of GLM's functions, and none is fused or approximate, so
// that a lane gives the same bits under every instruction set.

template <typename T>
using LanesOf = hn::CappedTag<T, 64 / sizeof(T)>;
template <typename T>
constexpr int lane_count() {
  return static_cast<int>(hn::MaxLanes(LanesOf<T>()));
}

template <typename T>
struct LaneReal {
  using Value = hn::Vec<LanesOf<T>>;
  using Mask = hn::Mask<LanesOf<T>>;
  Value v;

  explicit LaneReal(Value value) : v(value) {}
  explicit LaneReal(double all) : v(hn::Set(LanesOf<T>(), static_cast<T>(all))) {}
  explicit LaneReal(int all) : LaneReal(static_cast<double>(all)) {}
  explicit LaneReal(float all) : LaneReal(static_cast<double>(all)) {}
  static LaneReal load(const T* p) { return LaneReal(hn::LoadU(LanesOf<T>(), p)); }
  void store(T* p) const { hn::StoreU(v, LanesOf<T>(), p); }

  LaneReal operator-() const { return LaneReal(hn::Neg(v)); }
  LaneReal operator+(LaneReal o) const { return LaneReal(hn::Add(v, o.v)); }
  LaneReal operator-(LaneReal o) const { return LaneReal(hn::Sub(v, o.v)); }
  LaneReal operator*(LaneReal o) const { return LaneReal(hn::Mul(v, o.v)); }
  LaneReal operator/(LaneReal o) const { return LaneReal(hn::Div(v, o.v)); }
  LaneReal& operator/=(LaneReal o) { return *this = *this / o; }
  Mask operator<(LaneReal o) const { return hn::Lt(v, o.v); }
  Mask operator>(LaneReal o) const { return hn::Gt(v, o.v); }
  Mask operator<=(LaneReal o) const { return hn::Le(v, o.v); }
  Mask operator==(LaneReal o) const { return hn::Eq(v, o.v); }
};

template <typename Mask>
bool any(Mask mask) {
  return !hn::AllFalse(LanesOf<float>(), hn::RebindMask(LanesOf<float>(), mask));
}

template <typename T>
LaneReal<T> choose(typename LaneReal<T>::Mask mask, LaneReal<T> a, LaneReal<T> b) {
  return LaneReal<T>(hn::IfThenElse(mask, a.v, b.v));
}
template <typename T>
LaneReal<T> max(LaneReal<T> a, LaneReal<T> b) {
  return choose(a < b, b, a);  // as GLM's, also where one is not a number
}
template <typename T>
LaneReal<T> min(LaneReal<T> a, LaneReal<T> b) {
  return choose(b < a, b, a);
}
template <typename T>
LaneReal<T> abs(LaneReal<T> a) {
  return LaneReal<T>(hn::Abs(a.v));
}
template <typename T>
LaneReal<T> sqrt(LaneReal<T> a) {
  return LaneReal<T>(hn::Sqrt(a.v));
}

template <typename T>
struct LaneVec3 {
  LaneReal<T> x, y, z;
  explicit LaneVec3(LaneReal<T> all) : x(all), y(all), z(all) {}
  LaneVec3(LaneReal<T> x_, LaneReal<T> y_, LaneReal<T> z_) : x(x_), y(y_), z(z_) {}
  template <typename Vector>
  static LaneVec3 all(const Vector& v) {
    return {LaneReal<T>(v.x), LaneReal<T>(v.y), LaneReal<T>(v.z)};
  }

  LaneVec3 operator-() const { return {-x, -y, -z}; }
  LaneVec3 operator+(LaneVec3 o) const { return {x + o.x, y + o.y, z + o.z}; }
  LaneVec3 operator-(LaneVec3 o) const { return {x - o.x, y - o.y, z - o.z}; }
  LaneVec3 operator*(LaneVec3 o) const { return {x * o.x, y * o.y, z * o.z}; }
  LaneVec3 operator/(LaneReal<T> s) const { return {x / s, y / s, z / s}; }
};
template <typename T>
LaneVec3<T> operator*(LaneReal<T> s, LaneVec3<T> v) {
  return {s * v.x, s * v.y, s * v.z};
}
template <typename T>
LaneVec3<T> choose(typename LaneReal<T>::Mask mask, LaneVec3<T> a, LaneVec3<T> b) {
  return {choose(mask, a.x, b.x), choose(mask, a.y, b.y), choose(mask, a.z, b.z)};
}
template <typename T>
LaneReal<T> dot(LaneVec3<T> a, LaneVec3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
LaneVec3<T> cross(LaneVec3<T> a, LaneVec3<T> b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
template <typename T>
LaneVec3<T> normalize(LaneVec3<T> v) {
  return (LaneReal<T>(1) / sqrt(dot(v, v))) * v;
}
template <typename T>
LaneVec3<T> reflect(LaneVec3<T> v, LaneVec3<T> normal) {
  return v - LaneReal<T>(2) * (dot(normal, v) * normal);
}

/// A vector of points from number `first` of a structure of arrays.
template <int kRoom>
LaneVec3<float> vector_at(const float (&values)[3][kRoom], int first) {
  return {LaneReal<float>::load(values[0] + first), LaneReal<float>::load(values[1] + first),
          LaneReal<float>::load(values[2] + first)};
}
template <int kRoom>
void store_at(LaneVec3<float> v, float (&values)[3][kRoom], int first) {
  v.x.store(values[0] + first), v.y.store(values[1] + first), v.z.store(values[2] + first);
}

/// Three floats of each of a vector of points, before they are loaded.
struct LaneTriples {
  HWY_ALIGN float values[3][16];
  void set(int lane, const vec3& v) { values[0][lane] = v.x, values[1][lane] = v.y, values[2][lane] = v.z; }
  vec3 get(int lane) const { return {values[0][lane], values[1][lane], values[2][lane]}; }
  LaneVec3<float> load() const {
    return {LaneReal<float>::load(values[0]), LaneReal<float>::load(values[1]), LaneReal<float>::load(values[2])};
  }
};

/// As log2_by_series(), to the bit.
inline LaneReal<float> log2(LaneReal<float> x) {
  using Real = LaneReal<float>;
  constexpr LanesOf<float> kLanes;
  constexpr hn::RebindToSigned<LanesOf<float>> kInts;
  const auto bits = hn::BitCast(kInts, x.v);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(kInts, kLeastMantissaBits)));
  const Real m(hn::BitCast(kLanes, hn::Sub(bits, hn::ShiftLeft<23>(exponent))));
  const Real s = (m - Real(1)) / (m + Real(1)), s2 = s * s;
  Real series = Real(2.8853900817779268 / 9);
  for (const double term : {2.8853900817779268 / 7, 2.8853900817779268 / 5, 2.8853900817779268 / 3, 2.8853900817779268})
    series = series * s2 + Real(term);
  return Real(hn::ConvertTo(kLanes, exponent)) + s * series;
}

/// `x` >= 0 to the power of `y` > 0; exact to about 1e-7 of the largest result for x <= 1. 2^(y log2 x), both by their
/// series.
inline LaneReal<float> pow(LaneReal<float> x, LaneReal<float> y) {
  using Real = LaneReal<float>;
  constexpr LanesOf<float> kLanes;
  constexpr hn::RebindToSigned<LanesOf<float>> kInts;
  // 2^t = 2^n e^(ln 2 (t - n)), n the nearest whole number.
  Real t = choose(x > Real(0), y * log2(x), Real(-200));
  const auto vanishes = t < Real(-126);
  t = Real(hn::Clamp(t.v, hn::Set(kLanes, -126.0f), hn::Set(kLanes, 127.0f)));
  const Real n(hn::Round(t.v)), r = (t - n) * Real(0.69314718055994531);
  Real power = Real(1.0 / 720);
  for (const double term : {1.0 / 120, 1.0 / 24, 1.0 / 6, 0.5, 1.0, 1.0}) power = power * r + Real(term);
  const auto scale = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(kInts, n.v), hn::Set(kInts, 127)));
  return choose(vanishes, Real(0), power * Real(hn::BitCast(kLanes, scale)));
}

#define HRT_FN inline
#define HRT_CHOOSE(condition, a, b) choose(condition, a, b)
#define HRT_ANY(condition) any(condition)
namespace surface_floats {
using Real = LaneReal<float>;
using Vec3 = LaneVec3<float>;
using Mask = LaneReal<float>::Mask;
#include "shaders/surface.glsl"
// after it
#include "core/trace/optics-inl.h"
}  // namespace surface_floats
namespace surface_doubles {
using Real = LaneReal<double>;
using Vec3 = LaneVec3<double>;
inline Real pow(Real, Real y) { return y; }  // no highlight is computed in double precision
#include "shaders/surface.glsl"
}  // namespace surface_doubles
#undef HRT_FN
#undef HRT_CHOOSE
#undef HRT_ANY

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
