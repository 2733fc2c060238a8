// Compiled once for every vector instruction set that includes it, hence the toggle instead of a #pragma once.
#if defined(HYBRIDRT_POINT_PAINT_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HYBRIDRT_POINT_PAINT_H
#undef HYBRIDRT_POINT_PAINT_H
#else
#define HYBRIDRT_POINT_PAINT_H
#endif

#include "core/scene/scene.h"
#include "core/trace/texture_lanes-inl.h"
#include "core/trace/texture_lookup.h"

HWY_BEFORE_NAMESPACE();
namespace hybridrt {
namespace HWY_NAMESPACE {

constexpr int kFloatsAtOnce = lane_count<float>();

/// What the materials of a vector of points say.
struct LanePaint {
  LaneVec3<float> kd, ks, ke;
  LaneReal<float> ns, opacity;
};

/// Texture coordinates of a vector of points, and what their pixels cover there.
struct LaneTexcoords {
  LaneVec2 uv;
  LaneReal<float> footprint;
};

template <typename Points>
LaneTexcoords texcoords_at(const Scene& scene, const Points& points, int first) {
  using Real = LaneReal<float>;
  const Textures& textures = *scene.textures;
  LaneTriples p[3];
  HWY_ALIGN float s[3][16], t[3][16];
  for (int i = 0; i < kFloatsAtOnce; ++i) {
    const uint32_t triangle = points.triangle[first + i];
    for (int k = 0; k < 3; ++k) {
      p[k].set(i, scene.vertex(triangle, k));
      const vec2& st = textures.texcoords[textures.triangle_texcoords[triangle][k]];
      s[k][i] = st.x, t[k][i] = st.y;
    }
  }
  const auto texcoord = [&](int k) { return LaneVec2(Real::load(s[k]), Real::load(t[k])); };
  const Real u = Real::load(points.u + first), v = Real::load(points.v + first);
  const LaneVec3<float> p0 = p[0].load();
  TextureLanes lookup{textures.words.data()};
  return {(Real(1) - u - v) * texcoord(0) + u * texcoord(1) + v * texcoord(2),
          lookup.pixel_footprint(p[1].load() - p0, p[2].load() - p0, texcoord(1) - texcoord(0),
                                 texcoord(2) - texcoord(0), vector_at(points.dir, first),
                                 Real::load(points.solid_angle + first), Real::load(points.distance + first))};
}

/// The paint of a vector of points, from number `first`. Points: SeenPoints or HitSurfaces<float>.
template <typename Points>
class PointPaint {
 public:
  PointPaint(const Scene& scene, const Points& points, int first) : scene_(scene), points_(points), first_(first) {}

  LanePaint paint() const {
    const uint32_t material = scene_.triangle_materials[points_.triangle[first_]];
    bool alike = !scene_.has_colors();
    for (int i = 1; i < kFloatsAtOnce && alike; ++i)
      alike = scene_.triangle_materials[points_.triangle[first_ + i]] == material;
    LanePaint paint = alike ? plain(scene_.materials[material]) : plain_of_each();
    if (scene_.textures) apply_textures(paint);
    return paint;
  }

 private:
  static LanePaint plain(const Material& m) {
    using Vector = LaneVec3<float>;
    return {Vector::all(m.kd), Vector::all(m.ks), Vector::all(m.ke), LaneReal<float>(m.ns), LaneReal<float>(m.opacity)};
  }

  LanePaint plain_of_each() const {
    LaneTriples kd, ks, ke;
    HWY_ALIGN float ns[16], opacity[16];
    for (int i = 0; i < kFloatsAtOnce; ++i) {
      const int point = first_ + i;
      const Material& m = scene_.material_of(points_.triangle[point]);
      const SurfaceColors<float> colors =
          plain_colors(scene_, points_.triangle[point], points_.u[point], points_.v[point]);
      kd.set(i, colors.kd), ks.set(i, colors.ks), ke.set(i, colors.ke);
      ns[i] = m.ns, opacity[i] = m.opacity;
    }
    return {kd.load(), ks.load(), ke.load(), LaneReal<float>::load(ns), LaneReal<float>::load(opacity)};
  }

  /// Once for each set of maps among the points: all lanes look it up, and those that have it keep what they find.
  void apply_textures(LanePaint& paint) const {
    HWY_ALIGN float has[16];
    uint32_t maps[16], any_maps = 0;
    for (int i = 0; i < kFloatsAtOnce; ++i)
      any_maps |= maps[i] = scene_.textures->triangle_maps[points_.triangle[first_ + i]];
    if (any_maps == 0) return;
    const LaneTexcoords at = texcoords_at(scene_, points_, first_);
    for (int first = 0; first < kFloatsAtOnce; ++first) {
      const uint32_t chosen = maps[first];
      if (chosen == 0) continue;
      for (int i = 0; i < kFloatsAtOnce; ++i) {
        has[i] = maps[i] == chosen;
        if (maps[i] == chosen) maps[i] = 0;
      }
      apply_maps(chosen, at, LaneReal<float>::load(has) > LaneReal<float>(0), paint);
    }
  }

  void apply_maps(uint32_t maps, const LaneTexcoords& at, LaneReal<float>::Mask has, LanePaint& paint) const {
    TextureLanes lookup{scene_.textures->words.data()};
    const auto mapped = [&](uint32_t kind, LaneVec3<float>& color) {
      color = choose(has, lookup.mapped_color(maps, kind, color, at.uv, at.footprint), color);
    };
    mapped(HRT_MAP_DIFFUSE, paint.kd), mapped(HRT_MAP_SPECULAR, paint.ks), mapped(HRT_MAP_EMITTED, paint.ke);
  }

  const Scene& scene_;
  const Points& points_;
  const int first_;
};

}  // namespace HWY_NAMESPACE
}  // namespace hybridrt
HWY_AFTER_NAMESPACE();

#endif
