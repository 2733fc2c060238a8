// See lanes-inl.h for the toggle.
#if defined(HYBRIDRT_RASTER_HOLE_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_RASTER_HOLE_LANES_H
#undef HYBRIDRT_RASTER_HOLE_LANES_H
#else
#define HYBRIDRT_RASTER_HOLE_LANES_H
#endif

#include <optional>

#include "core/raster/hole_placement.h"
#include "core/raster/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

/// How triangles lie on their maps of holes, one a lane; index 0: along x, in texels to the right, 1: along y,
/// downward. Counted from the triangle's corner 0, texel * unit / distance is linear on the screen: at pixel (x, y) of
/// the triangle's box at + x dx + y dy.
struct HoleTriangles {
  HWY_ALIGN float at[2][kLongestVector], dx[2][kLongestVector], dy[2][kLongestVector];
  HWY_ALIGN float start[2][kLongestVector];  ///< corner 0
  HWY_ALIGN float error[2][kLongestVector];  ///< in texels, inside the triangle
  HWY_ALIGN int32_t size[2][kLongestVector], first[kLongestVector], repeats[kLongestVector];  ///< see HolePlacement
};

/// Looks up holes, of a triangle in each lane or of one in all lanes, where single precision can tell the texel that
/// is_hole() reads.
class HoleLanes {
 public:
  HoleLanes(const Textures& textures, const HoleTriangles& t)
      : HoleLanes(
            textures, [](const float* p) { return load(p); }, [](const int32_t* p) { return hn::LoadU(kInts, p); }, t) {
  }
  HoleLanes(const Textures& textures, const HoleTriangles& t, int lane)
      : HoleLanes(
            textures, [lane](const float* p) { return all(p[lane]); },
            [lane](const int32_t* p) { return all_int(p[lane]); }, t) {}

  /// At pixels (x, y) of the triangle's box, `depth` being unit / distance there: of the samples that `may` be met,
  /// those in a hole are taken out, and only those that are certainly in none stay `sure`. `sure`: certainly inside.
  void decide(Floats x, Floats y, Floats depth, Mask& sure, Mask& may) const {
    Mask known = sure;
    Floats texel[2];
    const Floats distance = all(1) / depth;
    for (int axis = 0; axis < 2; ++axis) {
      const Floats from_start = sum_of(dx_[axis], x, sum_of(dy_[axis], y, at_[axis]));
      const Floats place = sum_of(from_start, distance, start_[axis]);
      texel[axis] = hn::Floor(place);
      const Floats share = place - texel[axis];
      known = hn::And(known, hn::And(hn::Lt(error_[axis], share), hn::Lt(share, all(1) - error_[axis])));
      // Where the map is clamped per_size_ is 0.
      const Floats turns = hn::Floor((texel[axis] + all(0.5f)) * per_size_[axis]);
      const Floats wrapped = hn::NegMulAdd(turns, size_[axis], texel[axis]);
      texel[axis] = hn::IfThenElseZero(known, hn::Max(hn::Min(wrapped, last_[axis]), all(0)));
    }
    Mask solid = known;
    if (!hn::AllFalse(kFloats, known)) {
      const Ints index = hn::ConvertTo(kInts, texel[1]) * width_ + (hn::ConvertTo(kInts, texel[0]) + first_);
      const Ints found = hn::GatherIndex(kInts, reinterpret_cast<const int32_t*>(words_), index);
      // An alpha of one half or more sets the highest bit.
      solid = hn::And(known, hn::RebindMask(kFloats, hn::Lt(found, all_int(0))));
    }
    may = hn::AndNot(hn::AndNot(solid, known), may);
    sure = solid;
  }

 private:
  template <typename Load, typename LoadInt>
  HoleLanes(const Textures& textures, const Load& get, const LoadInt& get_int, const HoleTriangles& t)
      : words_(textures.words.data()), first_(get_int(t.first)), width_(get_int(t.size[0])) {
    const Floats repeats = hn::ConvertTo(kFloats, get_int(t.repeats));
    for (int axis = 0; axis < 2; ++axis) {
      at_[axis] = get(t.at[axis]), dx_[axis] = get(t.dx[axis]), dy_[axis] = get(t.dy[axis]);
      start_[axis] = get(t.start[axis]), error_[axis] = get(t.error[axis]);
      size_[axis] = hn::ConvertTo(kFloats, get_int(t.size[axis]));
      per_size_[axis] = repeats / size_[axis], last_[axis] = size_[axis] - all(1);
    }
  }

  const uint32_t* words_;
  Ints first_, width_;
  Floats at_[2], dx_[2], dy_[2], start_[2], error_[2], size_[2], per_size_[2], last_[2];
};

/// The same of a triangle with holes; without `holes` nothing is known about them.
HWY_INLINE void decide_holes(const std::optional<HoleLanes>& holes, Floats x, Floats y, Floats depth, Mask& sure,
                             Mask& may) {
  if (holes)
    holes->decide(x, y, depth, sure, may);
  else
    sure = first_lanes(0);
}

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
