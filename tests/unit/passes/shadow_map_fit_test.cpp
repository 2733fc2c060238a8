#include "core/passes/shadow_map_fit.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "core/passes/receiver_hull.h"
#include "core/passes/shadow_warp.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr int kMap_px = 1024;

double log_between(Random& random, double lo, double hi) { return lo * std::pow(hi / lo, random.unit()); }

dvec3 direction(Random& random) { return glm::normalize(dvec3(random.direction())); }

View view_along(const dvec3& eye, const dvec3& forward, const dvec3& up, double fov_y_rad = 0.8) {
  return make_view({eye, eye + forward, up, fov_y_rad}, dvec3(0), 640, 480);
}

/// The light's box around all receivers and a caster above them.
LightFrame light_over(const dvec3& toward, const View& view, const std::vector<dvec3>& receivers) {
  Scene scene;
  vec3 first(view.eye + receivers[0]);
  for (const dvec3& p : receivers) add_triangle(scene, first, vec3(view.eye + p), vec3(view.eye + p + toward));
  return fit_light_frame(scene, toward);
}

/// Random points relative to the eye, in front of it and within the picture.
std::vector<dvec3> random_receivers(Random& random, const View& view, int count, double nearest, double farthest) {
  std::vector<dvec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(log_between(random, nearest, farthest) *
                     view.pixel_dir(static_cast<int>(random.below(640)), static_cast<int>(random.below(480))));
  return points;
}

dvec4 in_map(const ShadowMapFit& fit, const dvec3& point) { return fit.map_from_origin * dvec4(point - fit.origin, 1); }

/// The scene's point at a place in the map.
dvec3 scene_point(const ShadowMapFit& fit, const dvec2& uv, double z) {
  const double w = shadow_warp_double::map_w(uv.y, fit.inverse_w_slope);
  return fit.origin + dvec3(glm::inverse(fit.map_from_origin) * dvec4(uv * w, z, w));
}

struct Case {
  View view;
  LightFrame light;
  std::vector<dvec3> receivers;
};

/// Light from everywhere: along the view, against it, near both, along axes.
Case random_case(Random& random, int i) {
  const dvec3 forward = i % 7 == 0 ? dvec3(0, 0, -1) : direction(random);
  const dvec3 eye = log_between(random, 1e-3, 1e5) * direction(random);
  Case c;
  c.view = view_along(eye, forward, direction(random), random.between(0.01f, 2.5f));
  dvec3 toward = direction(random);
  if (i % 11 == 0) toward = c.view.forward;
  if (i % 11 == 1) toward = -c.view.forward;
  if (i % 11 == 2) toward = glm::normalize(c.view.forward + log_between(random, 1e-9, 0.1) * direction(random));
  if (i % 11 == 3) toward = -glm::normalize(c.view.forward + log_between(random, 1e-9, 0.1) * direction(random));
  if (i % 11 == 4) toward = i % 2 ? dvec3(0, 1, 0) : dvec3(0, 0, -1);
  const double nearest = log_between(random, 1e-5, 1e3);
  c.receivers = random_receivers(random, c.view, 1 + static_cast<int>(random.below(20)), nearest,
                                 nearest * log_between(random, 1, 1e5));
  c.light = light_over(toward, c.view, c.receivers);
  return c;
}

TEST(ShadowMapFit, IsFiniteAndHoldsItsReceiversUnderEveryLight) {
  Random random(2004);
  int warped = 0;
  for (int i = 0; i < 120'000; ++i) {
    const Case c = random_case(random, i);
    const int size_px = 1 << random.below(13);
    const ShadowMapFit fit = fit_shadow_map(c.light, c.view, c.receivers, size_px);
    const mat4 in_float(fit.map_from_origin);
    for (int column = 0; column < 4; ++column)
      for (int k = 0; k < 4; ++k) ASSERT_TRUE(std::isfinite(in_float[column][k])) << i;
    for (double x : {fit.texel_across, fit.texel_along, fit.lean_first, fit.lean_step})
      ASSERT_TRUE(std::isfinite(static_cast<float>(x))) << i;
    ASSERT_GT(fit.texel_across, 0) << i;
    ASSERT_GT(fit.texel_along, 0) << i;
    ASSERT_LE(fit.inverse_w_slope, 0) << i;
    ASSERT_GT(fit.inverse_w_slope, -1 + 1e-6) << i;  // w is positive and finite over the map
    warped += fit.inverse_w_slope < -0.1;
    // Two texels inside, or an eighth of a small map, minus rounding.
    const double margin = 0.99 * std::min(2.0, size_px / 8.0) / size_px;
    for (const dvec3& p : c.receivers) {
      const dvec4 q = in_map(fit, c.view.eye + p);
      ASSERT_GE(q.w, 1 - 1e-6) << i;
      for (int k = 0; k < 2; ++k) {
        ASSERT_GE(q[k] / q.w, margin) << i;
        ASSERT_LE(q[k] / q.w, 1 - margin) << i;
      }
      const double rounding =
          0x1p-22 * glm::length(c.view.eye + p) / (c.light.hi.z - c.light.lo.z);  // rounding of the scene
      ASSERT_GT(q.z, -1 - rounding) << i;
      ASSERT_LT(q.z, 1 + rounding) << i;
    }
  }
  EXPECT_GT(warped, 30'000);
}

// z is a point's place along the light, and w does not depend on it: whatever is nearer to the light is in the same
// texel.
TEST(ShadowMapFit, DepthIsLinearAlongTheLight) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    Case c;
    c.view = view_along(10.0 * direction(random), direction(random), direction(random));
    c.receivers = random_receivers(random, c.view, 12, 1, 20);
    c.light = light_over(direction(random), c.view, c.receivers);
    const ShadowMapFit fit = fit_shadow_map(c.light, c.view, c.receivers, kMap_px);
    const double range = c.light.hi.z - c.light.lo.z;
    for (const dvec3& p : c.receivers) {
      const double up = range * random.unit();
      const dvec4 q = in_map(fit, c.view.eye + p), above = in_map(fit, c.view.eye + p + up * c.light.toward);
      EXPECT_NEAR(above.w, q.w, 1e-6 * q.w);
      EXPECT_NEAR(above.x / above.w, q.x / q.w, 1e-6);
      EXPECT_NEAR(above.y / above.w, q.y / q.w, 1e-6);
      EXPECT_NEAR(q.z - above.z, up / range, 1e-9);
    }
  }
}

// 1 / w along the rows, and a texel's size and lean, against finite differences.
TEST(ShadowMapFit, ShadersKnowWAndTexelsOfEveryPlace) {
  Random random(4);
  int leaning = 0;
  for (int i = 0; i < 1000; ++i) {
    const View view = view_along(10.0 * direction(random), direction(random), direction(random));
    const dvec3 toward = direction(random);
    const std::vector<dvec3> receivers = random_receivers(random, view, 12, 1 + random.unit(), 20);
    const LightFrame light = light_over(toward, view, receivers);
    const ShadowMapFit fit = fit_shadow_map(light, view, receivers, kMap_px);
    const dvec2 uv(random.unit(), random.unit());
    const double z = random.unit(), range = light.hi.z - light.lo.z, step = 1e-4;
    const dvec4 back = in_map(fit, scene_point(fit, uv, z));
    const double w = shadow_warp_double::map_w(uv.y, fit.inverse_w_slope);
    EXPECT_NEAR(back.w, w, 1e-9 * w);
    EXPECT_NEAR(back.x / back.w, uv.x, 1e-9);
    EXPECT_NEAR(back.y / back.w, uv.y, 1e-9);

    const auto a_texel = [&](const dvec2& toward_uv) {
      return (scene_point(fit, uv + step * toward_uv, z) - scene_point(fit, uv - step * toward_uv, z)) /
             (2 * step * kMap_px * range);
    };
    const dvec3 across = a_texel({1, 0}), along = a_texel({0, 1});
    const double lean = fit.lean_first + fit.lean_step * uv.x;
    const dvec2 texel = shadow_warp_double::texel_size(fit.texel_across, fit.texel_along, w);
    EXPECT_NEAR(glm::dot(across, fit.across), texel.x, 1e-4 * texel.x);
    EXPECT_NEAR(glm::dot(along, fit.along), texel.y, 1e-4 * texel.y);
    EXPECT_NEAR(glm::dot(along, fit.across), lean * texel.y, 1e-4 * texel.y * (1 + std::abs(lean)));
    leaning += std::abs(lean) > 0.2;

    // On a plane, depth changes over half a texel by no more than the offset.
    const dvec2 gradient(random.between(-5, 5), random.between(-5, 5));
    double most = 0;
    for (double u : {-0.5, 0.5})
      for (double v : {-0.5, 0.5}) {
        const dvec3 moved = u * across + v * along;
        const dvec2 on_plane(glm::dot(moved, fit.across), glm::dot(moved, fit.along));
        most = std::max(most, std::abs(glm::dot(on_plane, gradient)));
      }
    EXPECT_NEAR(0.5 * shadow_warp_double::depth_over_texel(gradient, texel, lean), most, 1e-3 * most);
  }
  EXPECT_GT(leaning, 100);
}

// On paper: with light square to the view, n = z0 + sqrt(z0 z1), so w at the far end is sqrt(z1 / z0) times that at the
// near one.
TEST(ShadowMapFit, WarpIsTheOptimalOne) {
  const View view = view_along({3, 2, 1}, {0, 0, -1}, {0, 1, 0});
  for (double ratio : {1.5, 4.0, 25.0, 900.0}) {
    const std::vector<dvec3> receivers = {{-0.5, 0, -2}, {0.5, 0, -2}, {-0.5, 0, -2 * ratio}, {0.5, 0, -2 * ratio}};
    const ShadowMapFit fit = fit_shadow_map(light_over({0, 1, 0}, view, receivers), view, receivers, kMap_px);
    const double w_near = in_map(fit, view.eye + receivers[0]).w, w_far = in_map(fit, view.eye + receivers[2]).w;
    EXPECT_NEAR(w_far / w_near, std::sqrt(ratio), 1e-3 * ratio);
  }
}

TEST(ShadowMapFit, LightAlongTheViewIsFittedWithoutWarp) {
  Random random(5);
  for (double angle : {0.0, 0.005, 0.019, kPi - 0.019, kPi}) {
    const View view = view_along({3, 2, 1}, {0, 0, -1}, {0, 1, 0});
    const std::vector<dvec3> receivers = random_receivers(random, view, 20, 1, 100);
    const LightFrame light = light_over({std::sin(angle), 0, std::cos(angle)}, view, receivers);
    const ShadowMapFit fit = fit_shadow_map(light, view, receivers, kMap_px);
    EXPECT_EQ(fit.inverse_w_slope, 0) << angle;
    EXPECT_EQ(in_map(fit, view.eye + receivers[3]).w, 1) << angle;
  }
}

// Under a low light a floor seen from above would be a thin line across the map; leaning fills it.
TEST(ShadowMapFit, ReceiversFillTheMap) {
  const View view = view_along({0, 5, 0}, {0, -0.5, -1}, {0, 1, 0});
  std::vector<dvec3> floor;
  for (double x : {-8.0, 8.0})
    for (double z : {-4.0, -20.0}) floor.push_back(dvec3(x, 0, z) - view.eye);
  const dvec3 toward = glm::normalize(dvec3(1, 0.01, 0));
  const LightFrame light = light_over(toward, view, floor);
  const ShadowMapFit fit = fit_shadow_map(light, view, floor, kMap_px);
  // Seen along the light it is 16 * 0.01 high.
  EXPECT_LT(fit.texel_across * (light.hi.z - light.lo.z) * kMap_px, 4 * 0.16);
  EXPECT_GT(std::abs(fit.lean_first), 0.3);
}

TEST(ShadowMapFit, NothingSeenIsTheUniformMap) {
  const View view = view_along({3, 2, 1}, {0, 0, -1}, {0, 1, 0});
  const LightFrame light = fit_light_frame(closed_box(), {0, 1, 0});
  const ShadowMapFit fit = fit_shadow_map(light, view, {}, kMap_px), uniform = uniform_shadow_map(light, kMap_px);
  EXPECT_EQ(fit.map_from_origin, uniform.map_from_origin);
  EXPECT_EQ(fit.texel_across, uniform.texel_across);
  EXPECT_FALSE(fit.warped);
}

// The hull holds every pixel's point: along no direction does one lie beyond it.
TEST(ReceiverHull, HoldsWhatEveryPixelSees) {
  Random random(6);
  constexpr double kNear = 1e-3;
  for (int i = 0; i < 20; ++i) {
    View view = make_view({dvec3(0), direction(random), direction(random), 1}, dvec3(0), 100, 70);
    if (i % 2) view = part_of(view, 13, 7, 50, 41);
    view.sample_px = {random.unit() - 0.5, random.unit() - 0.5};
    std::vector<dvec3> seen;
    const int across = receiver_blocks(view.width_px), down = receiver_blocks(view.height_px);
    std::vector<vec2> blocks(static_cast<size_t>(across) * down, vec2(0, 2));
    for (int y = 0; y < view.height_px; ++y)
      for (int x = 0; x < view.width_px; ++x) {
        if (random.below(3) == 0 || x < 20) continue;  // some see nothing, and some blocks
        const auto depth = static_cast<float>(kNear / log_between(random, 0.1, 50));
        seen.push_back(kNear / static_cast<double>(depth) * view.pixel_dir(x, y));
        vec2& block = blocks[static_cast<size_t>(y / 16) * across + x / 16];
        block = {std::max(block.x, depth), std::min(block.y, depth)};
      }
    const std::vector<dvec3> hull = receiver_hull(view, kNear, blocks);
    EXPECT_LE(hull.size(), 8 * blocks.size());
    EXPECT_TRUE(receiver_hull(view, kNear, std::vector<vec2>(blocks.size(), vec2(0, 2))).empty());
    for (int k = 0; k < 100; ++k) {
      const dvec3 axis = direction(random);
      const auto farthest = [&](const std::vector<dvec3>& points) {
        double most = -1e300;
        for (const dvec3& p : points) most = std::max(most, glm::dot(p, axis));
        return most;
      };
      EXPECT_LE(farthest(seen), farthest(hull) * (1 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace hybridrt
