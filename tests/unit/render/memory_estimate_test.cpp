#include "core/render/memory_estimate.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/procedural/spheres.h"
#include "core/render/render_job.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

TEST(FrameMemory, GrowsWithPixelsAndSlots) {
  RenderSettings settings;
  settings.shadows = ShadowMode::none;
  const MemoryEstimate one = estimate_frame_memory(settings, 1, 2, 1);
  settings.width_px *= 2;
  const MemoryEstimate wide = estimate_frame_memory(settings, 1, 2, 1);
  EXPECT_EQ(wide.total(), 2 * one.total());
  settings.crop = PixelRect{0, 0, settings.width_px / 2, settings.height_px};
  EXPECT_EQ(estimate_frame_memory(settings, 1, 2, 1).total(), one.total());
  settings.frames_in_flight = 4;
  EXPECT_EQ(estimate_frame_memory(settings, 1, 2, 1).frames, 2 * one.frames);
  settings.method = Method::raytrace;
  EXPECT_EQ(estimate_frame_memory(settings, 1, 2, 1).gpu_frames, 0u);
}

// A mask with its readback and the answers, and a shadow map or a light buffer.
TEST(FrameMemory, GrowsWithLights) {
  RenderSettings settings;
  settings.shadows = ShadowMode::map;
  const size_t pixels = size_t{1024} * 768, map = size_t{4} * settings.shadow_map_px * settings.shadow_map_px;
  const auto frames = [&](size_t lights) { return estimate_frame_memory(settings, lights, 2, 1); };
  EXPECT_EQ(frames(3).gpu_frames - frames(1).gpu_frames, 2 * (map + settings.frames_in_flight * pixels * 3));
  EXPECT_EQ(frames(3).frames - frames(1).frames, 2 * settings.frames_in_flight * pixels);
  const Scene scene = textured_room();
  settings.shadows = ShadowMode::exact;
  const auto accelerator = [&](size_t lights) {
    return estimate_memory(scene, make_scene_facts(scene), Topology(), Sheets(), settings, lights, false, 1, 1)
        .accelerator;
  };
  EXPECT_EQ(accelerator(3) - accelerator(2), accelerator(2) - accelerator(1));
  EXPECT_GT(accelerator(2), accelerator(1));
  EXPECT_GT(accelerator(1) - accelerator(0), accelerator(2) - accelerator(1)) << "the first also pays for building";
}

// Its maps are the GL form's, and drawing them takes lists of triangles.
TEST(FrameMemory, ShadowMapsOfTheCpuCount) {
  RenderSettings settings;
  settings.forms = PassForms::cpu;
  settings.shadows = ShadowMode::map;
  const size_t pixels = size_t{1024} * 768, map = size_t{4} * settings.shadow_map_px * settings.shadow_map_px;
  const auto frames = [&](size_t lights) { return estimate_frame_memory(settings, lights, 2, 1); };
  EXPECT_EQ(frames(1).gpu_frames, 0u);
  EXPECT_EQ(frames(3).frames - frames(1).frames, 2 * (map + 2 * pixels));
  const size_t whole = frames(1).frames;
  settings.shadows = ShadowMode::none;
  EXPECT_GT(whole - frames(1).frames, map);
  const Scene scene = textured_room();
  const auto accelerator = [&] {
    return estimate_memory(scene, make_scene_facts(scene), Topology(), Sheets(), settings, 1, false, 1, 1).accelerator;
  };
  settings.method = Method::raster;
  const size_t without = accelerator();
  settings.shadows = ShadowMode::map;
  EXPECT_GT(accelerator(), without);
}

TEST(FrameMemory, IsBoundedByThePicturesThatWaitNotByTheSequence) {
  const RenderSettings settings;
  const size_t one = estimate_frame_memory(settings, 1, 2, 1).pictures;
  EXPECT_EQ(one, size_t{1024} * 768 * 12);
  EXPECT_EQ(estimate_frame_memory(settings, 1, 2, 1'000'000'000).pictures, 8 * one) << "64 MiB, and the current one";
  EXPECT_EQ(estimate_frame_memory(settings, 1, 2, 3).pictures, 3 * one);
  EXPECT_EQ(estimate_frame_memory(settings, 1, 16, 1'000'000'000).pictures, 19 * one) << "one a thread, two waiting";
  RenderSettings with_aovs;
  with_aovs.aovs = kAovId | kAovDepth;
  EXPECT_EQ(estimate_frame_memory(with_aovs, 1, 2, 1).pictures, 3 * one);
}

// docs/architecture.md, Memory: components 4 bytes per triangle, sheets 13.
TEST(SceneMemory, AJobKeepsNoEdges) {
  ThreadPool pool(2);
  Warnings warnings;
  RenderJob job;
  set_scene(job, make_spheres({20000, 10}), pool, warnings);
  const size_t triangles = job.scene.triangle_count();
  EXPECT_EQ(memory_bytes(job.sheets), 13 * triangles);
  EXPECT_EQ(memory_bytes(job.topology), 4 * triangles + bytes_of(job.topology.components));
  EXPECT_GT(job.topology.components.size(), 1u) << "what is left is still known";
  EXPECT_GT(job.topology.edge_count, triangles);
}

TEST(SceneMemory, TexturesCountTwiceWithGl) {
  Scene scene = textured_room();
  const size_t textures = scene.textures->memory_bytes();
  EXPECT_GT(textures, 4 * (12 * 7 + 32 * 32));
  RenderSettings settings;
  const auto estimate = [&] {
    return estimate_memory(scene, make_scene_facts(scene), Topology(), Sheets(), settings, 1, false, 1, 1);
  };
  const MemoryEstimate with = estimate();
  scene.textures = nullptr;
  EXPECT_EQ(with.scene - estimate().scene, textures);
  EXPECT_EQ(with.gpu_scene - estimate().gpu_scene, textures);
  settings.method = Method::raytrace;
  EXPECT_EQ(estimate().gpu_scene, 0u);
}

TEST(FrameMemory, IsRefusedAboveTheLimit) {
  const RenderSettings settings;
  const uint64_t needed = estimate_frame_memory(settings, 1, 2, 10).total();
  EXPECT_NO_THROW(require_room_for_frames(settings, 1, 2, 10, 7, needed + 7));
  try {
    require_room_for_frames(settings, 1, 2, 10, 7, needed + 6);
    ADD_FAILURE() << "not refused";
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(refused.what()).find("1024x768"), std::string::npos);
  }
}

}  // namespace
}  // namespace hybridrt
