#include "core/render/mapped_renderer.h"

#include <gtest/gtest.h>

#include "core/render/samples.h"
#include "tests/gl/frame_test.h"

namespace hybridrt {
namespace {

// Samples differ by less than a pixel: a warped map that is fitted to the first one serves all of a frame.
TEST(MappedRenderer, AWarpedMapIsDrawnOnceForAllSamplesOfAFrame) {
  RenderJob job = orbit_job("scene:spheres,triangles=2000,reflective=0", 6);
  job.settings.shadows = ShadowMode::map;
  ThreadPool pool(2);
  std::vector<double> map_ms;
  int begun = 0;
  render_mapped(
      job.scene, job.facts, job.sheets, job.settings, nullptr, pool,
      [&]() -> std::optional<FrameRequest> {
        if (begun == 6) return std::nullopt;
        FrameRequest request{1, camera_at(job.motion, 1 + begun / 3), job.lights.lights};
        request.sample_offset_px = sample_offset_px(begun++ % 3);
        return request;
      },
      [&](Frame&& frame) { map_ms.push_back(frame.timings[PassId::shadow_map]); });
  ASSERT_EQ(map_ms.size(), 6u);
  for (size_t i = 0; i < map_ms.size(); ++i) EXPECT_EQ(map_ms[i] > 0, i % 3 == 0) << i;
}

}  // namespace
}  // namespace hybridrt
