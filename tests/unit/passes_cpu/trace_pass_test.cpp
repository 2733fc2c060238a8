// Pass 4 and whole frames on the CPU: what is traced, counted and left alone.

#include "core/passes_cpu/trace_pass.h"

#include <gtest/gtest.h>

#include "core/procedural/spheres.h"
#include "core/trace/embree_caster.h"
#include "core/trace/kd_caster.h"
#include "core/trace/primary_surface.h"
#include "shaders/shared.h"
#include "tests/support/primary_shadow_query.h"

namespace hybridrt {
namespace {

constexpr int kWidth_px = 131, kHeight_px = 77, kPixels = kWidth_px * kHeight_px;

class TracePass : public testing::Test {
 protected:
  struct Result {
    std::vector<uint8_t> lit = std::vector<uint8_t>(kPixels, 99);
    std::vector<vec4> traced = std::vector<vec4>(kPixels, vec4(99));
    TraceStats stats;
  };

  Result pass(const std::vector<uint8_t>& mask, bool want_lit, bool want_traced, int threads = 1) const {
    Result result;
    ThreadPool pool(threads);
    TracePixels pixels{ids_, mask, {}, {}};
    if (want_lit) pixels.lit = result.lit;
    if (want_traced) pixels.traced = result.traced;
    result.stats = trace_pass(job_, caster_.get(), pool, pixels);
    return result;
  }

  template <typename Real>
  std::vector<vec4> whole_frame(const RayCaster<Real>& caster, TraceStats& stats) {
    std::vector<vec4> picture(kPixels);
    ids_.resize(kPixels);
    lit_.resize(kPixels);
    stats = trace_frame(job_, caster, pool_, TracedFrame<Real>{picture, ids_, lit_});
    return picture;
  }

  void SetUp() override {
    caster_ = make_kd_caster(tree_, LeafKernel::simd);
    picture_ = whole_frame(*caster_, frame_stats_);
  }

  const Scene scene_ = make_spheres({1500, 40});
  ThreadPool pool_{2};
  const KdTree tree_ = build_kd_tree(scene_, pool_);
  const View view_ = make_view({{2.5, 2, 3}, {0, 0.3, 0}, {0, 1, 0}, 0.8}, dvec3(0), kWidth_px, kHeight_px);
  const dvec3 toward_ = glm::normalize(dvec3(-1, 1, 0.5));
  const TraceJob job_{scene_, view_, {{{toward_, vec3(1)}}}, true, 3};
  std::unique_ptr<RayCaster<float>> caster_;
  std::vector<vec4> picture_;
  std::vector<uint32_t> ids_;
  std::vector<uint8_t> lit_;
  TraceStats frame_stats_;
};

TEST_F(TracePass, WithoutAMaskEveryReceiverAsksOneRayOrFacesAway) {
  const Result all = pass({}, true, false);
  EXPECT_EQ(all.stats.pixels_marked, all.stats.pixels_hit);
  EXPECT_LE(all.stats.primary_shadow_rays, all.stats.pixels_hit);
  EXPECT_EQ(all.stats.shadow_rays, all.stats.primary_shadow_rays);
  EXPECT_EQ(all.stats.reflection_rays, 0) << "scattered light was not wanted";
  // Shadows are those of the whole frame: both ask for the same ids.
  int wrong = 0;
  for (int i = 0; i < kPixels; ++i) {
    ASSERT_TRUE(all.lit[i] == 0 || all.lit[i] == HRT_MASK_LIT);
    wrong += all.lit[i] != lit_[i];
  }
  EXPECT_LE(wrong, kPixels / 2000);
}

TEST_F(TracePass, WithALightBufferTheAnswersAreThoseOfDoublePrecision) {
  const Sheets sheets = make_sheets(scene_, build_topology(scene_, pool_), pool_);
  const LightBuffer buffer = build_light_buffer(scene_, sheets, toward_, pool_);
  const auto reference = make_reference_caster(tree_);
  TraceJob job = job_;
  job.lights[0].buffer = &buffer;

  Result hybrid;
  TracePixels pixels{ids_, {}, hybrid.lit, {}};
  const TraceStats stats = trace_pass(job, nullptr, pool_, pixels);
  int64_t asked = 0, shadowed = 0;
  for (int i = 0; i < kPixels; ++i) {
    bool lit = false;
    if (ids_[i] != kNoTriangle) {
      const dvec3 dir = glm::normalize(view_.pixel_dir(i % kWidth_px, i / kWidth_px));
      if (const auto query = primary_shadow_query(scene_, ids_[i], view_.eye, dir, toward_)) {
        const Ray<double> ray{query->origin, toward_};
        uint8_t occluded;
        reference->any_hits({&ray, 1}, {&occluded, 1});
        lit = !occluded;
        ++asked, shadowed += occluded;
      }
    }
    ASSERT_EQ(hybrid.lit[i] == HRT_MASK_LIT, lit) << i;
  }
  EXPECT_EQ(stats.primary_shadow_rays, asked);
  EXPECT_GT(shadowed, asked / 100);

  // A whole frame on the CPU sees the same triangles here, and asks the same queries.
  std::vector<vec4> picture(kPixels);
  std::vector<uint32_t> ids(kPixels);
  std::vector<uint8_t> lit(kPixels);
  trace_frame(job, *caster_, pool_, TracedFrame<float>{picture, ids, lit});
  EXPECT_EQ(ids, ids_);
  EXPECT_EQ(lit, hybrid.lit);
}

TEST_F(TracePass, OnlyMarkedPixelsAsk) {
  std::vector<uint8_t> mask(kPixels);
  int64_t receivers = 0, marked = 0;
  for (int i = 0; i < kPixels; ++i) {
    // Wrong answers at unmarked pixels must stay: no ray is asked there.
    mask[i] = ids_[i] == kNoTriangle ? HRT_MASK_NO_RECEIVER : i % 3 == 0 ? HRT_MASK_LIT : 0;
    if (ids_[i] == kNoTriangle) continue;
    ++receivers;
    if (i % 7 == 0) mask[i] |= HRT_MASK_MARKED, ++marked;
  }
  const Result result = pass(mask, true, false), all = pass({}, true, false);
  EXPECT_EQ(result.stats.pixels_hit, receivers);
  EXPECT_EQ(result.stats.pixels_marked, marked);
  EXPECT_LE(result.stats.shadow_rays, marked);
  for (int i = 0; i < kPixels; ++i)
    ASSERT_EQ(int(result.lit[i]), ids_[i] == kNoTriangle      ? 0
                                  : mask[i] & HRT_MASK_MARKED ? all.lit[i]
                                                              : mask[i] & HRT_MASK_LIT)
        << i;
}

TEST_F(TracePass, ScatteredLightOnlyWhereTheMaterialAsks) {
  const Result result = pass({}, false, true);
  int64_t reflective = 0;
  for (int i = 0; i < kPixels; ++i) {
    const bool mirror = ids_[i] != kNoTriangle && scene_.material_of(ids_[i]).reflective();
    reflective += mirror;
    if (!mirror) {
      ASSERT_EQ(vec3(result.traced[i]), vec3(0)) << i;
    }
  }
  EXPECT_GT(reflective, 100);
  EXPECT_EQ(result.stats.pixels_reflective, reflective);
  EXPECT_GE(result.stats.reflection_rays, reflective);
  EXPECT_EQ(result.stats.primary_shadow_rays, 0);
  EXPECT_GT(result.stats.shadow_rays, 0) << "shadows in the reflections";
}

TEST_F(TracePass, ThreadsChangeNoBit) {
  const Result one = pass({}, true, true, 1);
  for (int threads : {2, 5}) {
    const Result many = pass({}, true, true, threads);
    EXPECT_EQ(one.lit, many.lit);
    EXPECT_TRUE(one.traced == many.traced);
    EXPECT_EQ(one.stats.shadow_rays, many.stats.shadow_rays);
    EXPECT_EQ(one.stats.reflection_rays, many.stats.reflection_rays);
  }
}

TEST_F(TracePass, FrameIsTheReferencesWithinRounding) {
  const std::vector<uint32_t> ids = ids_;
  TraceStats stats;
  const std::vector<vec4> reference = whole_frame(*make_reference_caster(tree_), stats);
  double sum = 0;
  int differing_ids = 0;
  for (int i = 0; i < kPixels; ++i) {
    if (ids[i] != ids_[i]) {
      ++differing_ids;
      continue;
    }
    const dvec3 error = dvec3(picture_[i]) - dvec3(reference[i]);
    sum += glm::dot(error, error);
    EXPECT_EQ(picture_[i].a, reference[i].a);
  }
  EXPECT_LE(differing_ids, kPixels / 2000);
  EXPECT_GE(-10 * std::log10(sum / (3.0 * kPixels) + 1e-30), 50) << "PSNR in dB";
}

TEST_F(TracePass, CastersAgree) {
  TraceStats stats;
  const std::vector<vec4> embree = whole_frame(*make_embree_caster(scene_, 1), stats);
  const std::vector<vec4> scalar = whole_frame(*make_kd_caster(tree_, LeafKernel::scalar), stats);
  EXPECT_TRUE(scalar == picture_) << "kernels give the same bits";
  int differ = 0;
  for (int i = 0; i < kPixels; ++i) differ += glm::distance(embree[i], picture_[i]) > 0.004f;
  EXPECT_LE(differ, kPixels / 1000);
}

TEST_F(TracePass, CountsAddUp) {
  TraceStats sum = frame_stats_;
  sum.add(frame_stats_);
  EXPECT_EQ(sum.pixels_hit, 2 * frame_stats_.pixels_hit);
  EXPECT_EQ(sum.shadow_rays, 2 * frame_stats_.shadow_rays);
  EXPECT_EQ(sum.refraction_rays, 2 * frame_stats_.refraction_rays);
  EXPECT_EQ(sum.secondary_cpu_ms, 2 * frame_stats_.secondary_cpu_ms);
}

}  // namespace
}  // namespace hybridrt
