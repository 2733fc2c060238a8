// Several samples per pixel: where they lie, and that their mean is delivered once.

#include "core/render/samples.h"

#include <gtest/gtest.h>

#include "core/passes_cpu/trace_pass.h"
#include "core/scene/view.h"
#include "core/trace/kd_caster.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

TEST(Samples, BeginInTheCentreAndCoverThePixelEvenly) {
  EXPECT_EQ(sample_offset_px(0), dvec2(0));
  for (int count : {16, 64, 256}) {
    // Boxes of 1/4 x 1/4 pixel: each holds its share, give or take three samples.
    int boxes[16] = {};
    dvec2 mean(0);
    for (int i = 0; i < count; ++i) {
      const dvec2 at = sample_offset_px(i) + 0.5;
      ASSERT_TRUE(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1) << i;
      ++boxes[static_cast<int>(4 * at.y) * 4 + static_cast<int>(4 * at.x)];
      mean += (at - 0.5) / static_cast<double>(count);
    }
    for (int inside : boxes) EXPECT_NEAR(inside, count / 16.0, 3) << count;
    EXPECT_LT(glm::length(mean), 1.0 / count + 0.05) << count;
  }
}

TEST(Samples, OneIsHandedOn) {
  const NextFrame next = sampled([] { return std::optional(FrameRequest{}); }, 1);
  EXPECT_EQ(next()->sample_offset_px, dvec2(0));
  int delivered = 0;
  const DeliverFrame deliver = averaged(
      [&](Frame&& frame) {
        ++delivered;
        EXPECT_EQ(frame.picture.data, Image(1, 1, 3, 0.3f).data);  // not divided by anything
      },
      1);
  Frame frame;
  frame.picture = Image(1, 1, 3, 0.3f);
  deliver(std::move(frame));
  EXPECT_EQ(delivered, 1);
}

TEST(Samples, RaysAndRasterLookAtTheSamePlace) {
  View view = make_view({{1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 0.8}, dvec3(0), 64, 48);
  const dvec3 centre = view.pixel_dir(10, 20), right = view.pixel_dir(11, 20), below = view.pixel_dir(10, 21);
  view.sample_px = {0.3, -0.2};
  const dvec3 dir = view.pixel_dir(10, 20);
  EXPECT_LT(glm::length(dir - (centre + 0.3 * (right - centre) - 0.2 * (below - centre))), 1e-14);

  // What lies there is drawn at the pixel's centre.
  const dvec4 clip = clip_from_eye(view, 0.1) * dvec4(dir, 1);
  EXPECT_NEAR((clip.x / clip.w + 1) / 2 * 64, 10.5, 1e-12);
  EXPECT_NEAR((1 - clip.y / clip.w) / 2 * 48, 20.5, 1e-12);
}

// Known on paper: four samples per pixel see what four pixels see at twice the resolution, with textures filtered
// alike; the level falls by half of log2(4).
TEST(Samples, FilterTexturesOverTheirPartOfThePixel) {
  View coarse = make_view({{1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 0.8}, dvec3(0), 24, 16);
  const View fine = make_view({{1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 0.8}, dvec3(0), 48, 32);
  const double whole = coarse.sample_solid_angle(5, 3);
  for (const int samples : {1, 2, 4, 9, 4096}) {
    coarse.samples = samples;
    EXPECT_DOUBLE_EQ(coarse.sample_solid_angle(5, 3), whole / samples);
  }

  const Scene scene = textured_room();
  ThreadPool pool(1);
  const KdTree tree = build_kd_tree(scene, pool);
  const auto picture_of = [&](const View& view) {
    std::vector<vec4> picture(static_cast<size_t>(view.width_px) * view.height_px);
    std::vector<uint32_t> ids(picture.size());
    trace_frame({scene, view, {}}, *make_reference_caster(tree), pool, TracedFrame<double>{picture, ids, {}});
    return picture;
  };
  const std::vector<vec4> expected = picture_of(fine);
  float gap = 0;
  for (const int samples : {4, 1}) {
    coarse.samples = samples;
    for (int i = 0; i < 4; ++i) {
      coarse.sample_px = {i % 2 * 0.5 - 0.25, i / 2 * 0.5 - 0.25};
      const std::vector<vec4> sampled = picture_of(coarse);
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 24; ++x) {
          const vec4 difference = sampled[static_cast<size_t>(y) * 24 + x] -
                                  expected[(static_cast<size_t>(2 * y) + i / 2) * 48 + 2 * x + i % 2];
          if (samples == 4) {
            ASSERT_LT(glm::length(difference), 1e-5f) << x << ' ' << y;
          }
          gap = std::max(gap, glm::length(difference));
        }
    }
  }
  EXPECT_GT(gap, 0.01f) << "as if each sample stood for a whole pixel, textures would be smoother";
}

TEST(Samples, AFrameIsTheMeanOfItsSamples) {
  int begun = 0;
  const NextFrame next = sampled(
      [&]() -> std::optional<FrameRequest> {
        if (++begun > 2) return std::nullopt;
        FrameRequest request;
        request.number = begun;
        return request;
      },
      3);
  std::vector<Frame> delivered;
  const DeliverFrame deliver = averaged([&](Frame&& frame) { delivered.push_back(std::move(frame)); }, 3);
  int asked = 0;
  while (const auto request = next()) {
    EXPECT_EQ(request->sample_offset_px, sample_offset_px(asked % 3));
    Frame frame;
    frame.number = request->number;
    frame.picture = Image(1, 1, 3);
    for (float& value : frame.picture.data) value = static_cast<float>(request->number * 10 + asked % 3);
    frame.timings[PassId::id] = 2;
    frame.timings.wall_ms = 5;
    frame.stats.shadow_rays = 7;
    deliver(std::move(frame));
    ++asked;
  }
  EXPECT_EQ(asked, 6);
  ASSERT_EQ(delivered.size(), 2u);
  EXPECT_EQ(delivered[1].number, 2);
  EXPECT_FLOAT_EQ(delivered[1].picture.data[0], 21);
  EXPECT_EQ(delivered[1].timings[PassId::id], 6);
  EXPECT_EQ(delivered[1].timings.wall_ms, 15);
  EXPECT_EQ(delivered[1].stats.shadow_rays, 21);
}

}  // namespace
}  // namespace hybridrt
