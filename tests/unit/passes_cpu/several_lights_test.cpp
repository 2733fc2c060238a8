// Several lights on the CPU: each has the shadow answers that it would have alone.

#include <gtest/gtest.h>
#include <list>

#include "core/passes_cpu/mark_boundary.h"
#include "core/passes_cpu/trace_pass.h"
#include "core/procedural/spheres.h"
#include "core/trace/kd_caster.h"
#include "shaders/shared.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

constexpr int kWidth_px = 131, kHeight_px = 77;
constexpr size_t kPixels = kWidth_px * kHeight_px;
using Bytes = std::vector<uint8_t>;

class SeveralLights : public testing::Test {
 protected:
  /// From above and from below, one of them without shadows.
  static std::vector<DirectionalLight> random_lights(uint32_t seed, size_t count) {
    Random random(seed);
    std::vector<DirectionalLight> lights;
    for (size_t i = 0; i < count; ++i)
      lights.push_back({glm::normalize(dvec3(random.direction())), random.in_cube(0.1f, 1), i != 1});
    return lights;
  }

  TraceJob job_with(const std::vector<DirectionalLight>& lights, bool buffers) {
    TraceJob job{scene_, view_, {}, true, 3};
    for (const DirectionalLight& light : lights) {
      job.lights.push_back({light});
      if (buffers && light.casts_shadow)
        job.lights.back().buffer = &buffers_.emplace_back(build_light_buffer(scene_, sheets_, light.toward, pool_));
    }
    return job;
  }

  template <typename Real>
  Bytes lit_in_frame(const TraceJob& job, const RayCaster<Real>& caster, TraceStats& stats) {
    std::vector<vec4> picture(kPixels);
    Bytes lit(job.lights.size() * kPixels, 99);
    ids_.resize(kPixels);
    stats = trace_frame(job, caster, pool_, TracedFrame<Real>{picture, ids_, lit});
    return lit;
  }

  /// `answer(job, stats)` for all lights at once and for one after the other; of those that cast shadows only where the
  /// others' answers mean nothing.
  template <typename Answer>
  void expect_each_as_alone(uint32_t seed, bool buffers, bool casting_only, const Answer& answer) {
    const std::vector<DirectionalLight> lights = random_lights(seed, 4);
    TraceStats stats, sum;
    const Bytes together = answer(job_with(lights, buffers), stats);
    ASSERT_EQ(together.size(), lights.size() * kPixels);
    size_t lit = 0;
    for (size_t l = 0; l < lights.size(); ++l) {
      if (casting_only && !lights[l].casts_shadow) continue;
      TraceStats alone_stats;
      const Bytes alone = answer(job_with({lights[l]}, buffers), alone_stats);
      EXPECT_TRUE(std::equal(alone.begin(), alone.end(), together.begin() + l * kPixels)) << "light " << l;
      lit += std::count(alone.begin(), alone.end(), HRT_MASK_LIT);
      sum.add(alone_stats);
    }
    EXPECT_GT(lit, kPixels / 10);
    EXPECT_EQ(stats.primary_shadow_rays, sum.primary_shadow_rays) << "counts are sums over the lights";
    EXPECT_EQ(stats.pixels_marked, sum.pixels_marked);
  }

  const Scene scene_ = make_spheres({1500, 40});
  ThreadPool pool_{2};
  const KdTree tree_ = build_kd_tree(scene_, pool_);
  const Sheets sheets_ = make_sheets(scene_, build_topology(scene_, pool_), pool_);
  const View view_ = make_view({{2.5, 2, 3}, {0, 0.3, 0}, {0, 1, 0}, 0.8}, dvec3(0), kWidth_px, kHeight_px);
  const std::unique_ptr<RayCaster<float>> caster_ = make_kd_caster(tree_, LeafKernel::simd);
  std::list<LightBuffer> buffers_;
  std::vector<uint32_t> ids_;
};

TEST_F(SeveralLights, WholeFrames) {
  const auto reference = make_reference_caster(tree_);
  for (uint32_t seed = 1; seed <= 3; ++seed)
    for (const bool buffers : {false, true}) {
      expect_each_as_alone(seed, buffers, false,
                           [&](const TraceJob& job, TraceStats& stats) { return lit_in_frame(job, *caster_, stats); });
      expect_each_as_alone(seed, buffers, false, [&](const TraceJob& job, TraceStats& stats) {
        return lit_in_frame(job, *reference, stats);
      });
    }
}

TEST_F(SeveralLights, PassFourAsksWhereEachLightIsMarked) {
  TraceStats stats;
  lit_in_frame(job_with({}, false), *caster_, stats);
  for (uint32_t seed = 4; seed <= 6; ++seed)
    for (const bool buffers : {false, true})
      for (const bool masked : {false, true})
        expect_each_as_alone(seed, buffers, true, [&](const TraceJob& job, TraceStats& pass_stats) {
          // The same bytes for a light whether it is alone or not.
          Bytes mask;
          for (const TracedLight& light : job.lights) {
            Random random(static_cast<uint32_t>(1e6 * (2 + light.light.toward.x)));
            for (size_t i = 0; i < kPixels; ++i)
              mask.push_back(ids_[i] == kNoTriangle ? HRT_MASK_NO_RECEIVER : static_cast<uint8_t>(random.below(4)));
          }
          Bytes lit(job.lights.size() * kPixels, 99);
          pass_stats = trace_pass(job, caster_.get(), pool_, {ids_, masked ? mask : Bytes(), lit, {}});
          return lit;
        });
}

TEST_F(SeveralLights, WhatIsMarkedAndAnswered) {
  TraceStats stats;
  lit_in_frame(job_with({}, false), *caster_, stats);
  for (uint32_t seed = 7; seed <= 9; ++seed) {
    MarkedShadows marked;  // kept, as renderers do
    const auto mark_and_answer = [&](const TraceJob& job, Bytes& mask, TraceStats& own_stats) {
      Bytes lit(job.lights.size() * kPixels, 99);
      mask.assign(lit.size(), 99);
      mark_boundary(job, pool_, ids_, mask, lit, marked);
      own_stats = answer_marked(job, pool_, marked, lit);
      return lit;
    };
    expect_each_as_alone(seed, true, true, [&](const TraceJob& job, TraceStats& own_stats) {
      Bytes mask;
      const Bytes lit = mark_and_answer(job, mask, own_stats);
      // No other answers than those of rays.
      Bytes asked(lit.size(), 0);
      trace_pass(job, nullptr, pool_, {ids_, {}, asked, {}});
      EXPECT_EQ(lit, asked);
      return lit;
    });
    expect_each_as_alone(seed, true, true, [&](const TraceJob& job, TraceStats& own_stats) {
      Bytes mask;
      mark_and_answer(job, mask, own_stats);
      return mask;
    });
  }
}

TEST_F(SeveralLights, WithoutAnyThereIsAmbientLightAndEmission) {
  Scene scene = scene_;
  for (Material& material : scene.materials) {
    material.ke = {0.25f, 0, 0.5f};
    material.reflect = material.transmit = vec3(0);
    material.fresnel = Fresnel::none;
  }
  const TraceJob job{scene, view_, {}, true, 3, vec3(0.5f), vec3(0.125f)};
  std::vector<vec4> picture(kPixels);
  std::vector<uint32_t> ids(kPixels);
  const TraceStats stats = trace_frame(job, *caster_, pool_, TracedFrame<float>{picture, ids, {}});
  EXPECT_EQ(stats.shadow_rays, 0);
  for (size_t i = 0; i < kPixels; ++i) {
    vec3 expected = job.background;
    if (ids[i] != kNoTriangle) {
      const Material& material = scene.material_of(ids[i]);
      expected = material.ke + material.opacity * job.ambient.color * material.kd;
    }
    ASSERT_EQ(vec3(picture[i]), expected) << i;
  }
}

}  // namespace
}  // namespace hybridrt
