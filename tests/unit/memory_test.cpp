#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/render/memory_estimate.h"
#include "textured_scenes.h"
#include "core/scene/loading_bytes.h"
#include "core/scene/mesh_io.h"
#include "core/scene/scene_source.h"
#include "tests/unit/temporary_folder.h"

namespace hybridrt {
namespace {

std::string ply_with(size_t vertices, size_t faces) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (size_t i = 0; i < vertices; ++i) text += std::to_string(i) + (i % 2 ? " 1 0\n" : " 0 0\n");
  for (size_t i = 0; i < faces; ++i) text += "3 0 1 2\n";
  return text;
}

std::string off_with(size_t vertices, size_t faces) {
  const std::string ply = ply_with(vertices, faces);
  return "OFF # made\n# by hand\n" + std::to_string(vertices) + " " + std::to_string(faces) + " 0\n" +
         ply.substr(ply.find("end_header\n") + 11);
}

TEST(AllowedMemory, IsWhatAMachineHas) {
  EXPECT_GT(allowed_memory(), uint64_t{64} << 20);
  EXPECT_LT(allowed_memory(), uint64_t{1} << 50) << "somebody says how much there is";
}

TEST(LoadingBytes, FollowTheCountsOfTheHeader) {
  const TemporaryFolder folder;
  const uint64_t small = loading_bytes(folder.write("a.ply", ply_with(300, 100)));
  EXPECT_GT(small, 300u * (24 + 12)) << "positions in double and float at least";
  EXPECT_EQ(loading_bytes(folder.write("b.ply", ply_with(3000, 1000))), 10 * small);
  EXPECT_EQ(loading_bytes(folder.write("a.off", off_with(300, 100))), small) << "the same mesh";

  std::string stl(84, '\0');
  stl[80] = 100;
  stl.append(100 * 50, '\0');
  EXPECT_EQ(loading_bytes(folder.write("a.stl", stl)), small) << "a hundred facets have three hundred vertices";
  EXPECT_EQ(loading_bytes(folder.write("a.obj", std::string(3000, '\n'))),
            2 * loading_bytes(folder.write("b.obj", std::string(1500, '\n'))));
}

TEST(LoadingBytes, BelieveNoPromiseThatTheFileHasNoRoomFor) {
  const TemporaryFolder folder;
  EXPECT_EQ(loading_bytes(folder.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\n"
                                                "property float x\nend_header\n1\n")),
            0u);
  EXPECT_LT(loading_bytes(folder.write("a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n")), 10'000u);
  EXPECT_EQ(loading_bytes(folder.path / "none.obj"), 0u);
  EXPECT_EQ(loading_bytes(folder.path), 0u);
}

/// What load_scene says with `most_bytes` allowed, or "" when it loads.
std::string refusal(const std::string& scene, uint64_t most_bytes) {
  ThreadPool pool(1);
  Warnings warnings;
  try {
    load_scene(scene, pool, warnings, std::nullopt, {most_bytes});
    return "";
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::input);
    return refused.what();
  }
}

TEST(LoadingBytes, LimitWhatIsLoaded) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.write("a.ply", ply_with(300, 100));
  const uint64_t needed = loading_bytes(path);
  EXPECT_EQ(refusal(path, needed), "");
  EXPECT_NE(refusal(path, needed - 1).find("--max-memory"), std::string::npos);
  const std::string twice = folder.write("twice.json", R"({"meshes": ["a.ply", "a.ply"]})").string();
  EXPECT_EQ(refusal(twice, 2 * needed), "");
  EXPECT_NE(refusal(twice, 2 * needed - 1).find("a.ply and the other meshes"), std::string::npos);
  EXPECT_EQ(refusal("scene:spheres,triangles=1000", 1 << 20), "");
  EXPECT_NE(refusal("scene:spheres,triangles=20000000", 1 << 20), "");
}

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
    return estimate_memory(scene, make_scene_facts(scene), settings, Accel::kdtree, lights, false, 1, 1).accelerator;
  };
  EXPECT_GT(accelerator(1), accelerator(0));
  EXPECT_EQ(accelerator(3) - accelerator(2), accelerator(1) - accelerator(0));
}

TEST(FrameMemory, IsBoundedByThePicturesThatWaitNotByTheSequence) {
  const RenderSettings settings;
  const size_t one = estimate_frame_memory(settings, 1, 2, 1).pictures;
  EXPECT_EQ(one, size_t{1024} * 768 * 12);
  EXPECT_EQ(estimate_frame_memory(settings, 1, 2, 1'000'000'000).pictures, 7 * one);
  RenderSettings with_aovs;
  with_aovs.aovs = kAovId | kAovDepth;
  EXPECT_EQ(estimate_frame_memory(with_aovs, 1, 2, 1).pictures, 3 * one);
}

TEST(SceneMemory, TexturesCountTwiceWithGl) {
  Scene scene = textured_room();
  const size_t textures = scene.textures->memory_bytes();
  EXPECT_GT(textures, 4 * (12 * 7 + 32 * 32));
  RenderSettings settings;
  const auto estimate = [&] {
    return estimate_memory(scene, make_scene_facts(scene), settings, Accel::kdtree, 1, false, 1, 1);
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
  EXPECT_NO_THROW(require_room_for_frames(settings, 1, 2, 10, needed));
  try {
    require_room_for_frames(settings, 1, 2, 10, needed - 1);
    ADD_FAILURE() << "not refused";
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(refused.what()).find("1024x768"), std::string::npos);
  }
}

}  // namespace
}  // namespace hybridrt
