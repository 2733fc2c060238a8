#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <malloc.h>

#include "core/base/parallel.h"
#include "core/gl/program.h"
#include "core/procedural/spheres.h"
#include "core/render/gl_renderer.h"
#include "tests/gl/gl_test.h"

namespace hybridrt {
namespace {

/// The message of the Error(device) that `action` throws.
template <typename Action>
std::string device_error(const Action& action) {
  try {
    action();
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::device) << failure.what();
    return failure.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

struct Held {
  int64_t threads, files;
  size_t bytes;
};

/// The resources that this process holds. Sanitizers have their own malloc: no bytes are counted then.
Held held() {
  const auto entries = [](const char* folder) {
    return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
  };
  const auto heap = mallinfo2();
  return {entries("/proc/self/task"), entries("/proc/self/fd"), heap.uordblks + heap.hblkhd};
}

struct Way {
  const char* name;
  gl::ContextRequest request;
  const char* binding;
};

class Contexts : public testing::TestWithParam<Way> {};

TEST_P(Contexts, OpensAndDraws) {
  std::unique_ptr<gl::Context> context;
  try {
    context = gl::open_context(GetParam().request);
  } catch (const Error& unavailable) {
    GTEST_SKIP() << unavailable.what();
  }
  const gl::ContextInfo& info = context->info();
  EXPECT_EQ(info.binding, GetParam().binding);
  EXPECT_GE(info.max_texture_px, 16384);  // the floor of OpenGL 4.5
  EXPECT_GE(info.max_buffer_texels, 65536);
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_FALSE(info.version.empty());

  const gl::Functions& gl = context->functions();
  const gl::Texture color(gl, GL_R32UI, 5, 3, "color"), depth(gl, GL_DEPTH_COMPONENT32F, 5, 3, "depth");
  const gl::Framebuffer target(gl, &color, depth, "target");
  const GLuint value[4] = {4'000'000'000u, 0, 0, 0};
  gl.ClearNamedFramebufferuiv(target.id(), GL_COLOR, 0, value);
  EXPECT_EQ(read_pixels<uint32_t>(gl, color, 5, 3, GL_RED_INTEGER, GL_UNSIGNED_INT),
            std::vector<uint32_t>(15, 4'000'000'000u));
}

// One context after the other in one process, as in `doctor`.
TEST_P(Contexts, OpensAgainAfterItWasClosed) {
  for (int i = 0; i < 3; ++i) {
    try {
      const std::unique_ptr<gl::Context> context = gl::open_context(GetParam().request);
      EXPECT_NE(context->functions().GetString(GL_VERSION), nullptr);
    } catch (const Error& unavailable) {
      ASSERT_EQ(i, 0) << unavailable.what();
      GTEST_SKIP() << unavailable.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Contexts,
                         testing::Values(Way{"egl_device", {gl::Binding::egl, "egl:0"}, "EGL device"},
                                         Way{"egl_surfaceless", {gl::Binding::egl, "surfaceless"}, "EGL surfaceless"},
                                         Way{"osmesa", {gl::Binding::osmesa, ""}, "OSMesa"},
                                         Way{"osmesa_by_id", {gl::Binding::any, "osmesa"}, "OSMesa"}),
                         [](const auto& way) { return way.param.name; });

TEST(ContextErrors, UnknownDeviceIsNamed) {
  for (const char* id : {"egl:99", "nonsense", "EGL:0"})
    EXPECT_NE(device_error([&] { gl::open_context({gl::Binding::any, id}); }).find(id), std::string::npos) << id;
}

TEST(ContextErrors, DeviceOfAnotherBindingIsNamed) {
  EXPECT_NE(device_error([] { gl::open_context({gl::Binding::egl, "osmesa"}); }).find("osmesa"), std::string::npos);
}

TEST(ContextErrors, RequiredHardwareSaysWhatWasTried) {
  try {
    const auto context = gl::open_context({gl::Binding::any, "", true});
    EXPECT_FALSE(context->info().software);
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::device);
    EXPECT_NE(std::string(refused.what()).find("tried"), std::string::npos) << refused.what();
  }
}

// Both when a device is refused after its context was made, and when no such device exists.
TEST(ContextErrors, LeaveNothingBehind) {
  std::vector<gl::DeviceInfo> failed;
  const std::vector<gl::ContextInfo> usable = usable_devices(failed);
  if (!std::all_of(usable.begin(), usable.end(), [](const auto& info) { return info.software; }))
    GTEST_SKIP() << "a hardware renderer is not refused";
  const auto try_all = [] {
    EXPECT_THROW(gl::open_context({gl::Binding::any, "", true}), Error);
    EXPECT_THROW(gl::open_context({gl::Binding::any, "egl:99"}), Error);
  };
  try_all();
  const Held before = held();
  for (int i = 0; i < 20; ++i) try_all();
  const Held after = held();
  EXPECT_LE(after.threads, before.threads);
  EXPECT_LE(after.files, before.files);
  EXPECT_LT(after.bytes, before.bytes + (1 << 20)) << "llvmpipe's contexts are as large each, or larger";
}

TEST(ContextErrors, ProbeFindsWhatOpens) {
  std::vector<gl::DeviceInfo> failed;
  for (const gl::ContextInfo& info : usable_devices(failed))
    EXPECT_EQ(gl::open_context({gl::Binding::any, info.device})->info().renderer, info.renderer);
  for (const gl::DeviceInfo& device : failed) {
    EXPECT_FALSE(device.problem.empty()) << device.id;
    EXPECT_THROW(gl::open_context({gl::Binding::any, device.id}), Error);
  }
}

TEST(Limits, AreNamed) {
  const std::string message = device_error([] { gl::require_limit("a picture width", 20000, "GL_MAX_X", 16384); });
  for (const char* part : {"a picture width", "20000", "GL_MAX_X", "16384"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_NO_THROW(gl::require_limit("a picture width", 16384, "GL_MAX_X", 16384));
}

class RendererLimits : public GlTest {};

TEST_F(RendererLimits, TooLargePicturesAreRefusedBeforeAnyWork) {
  const Scene scene = make_spheres({200, 0});
  ThreadPool pool(1);
  const int limit = context().info().max_texture_px;
  for (int RenderSettings::*member :
       {&RenderSettings::width_px, &RenderSettings::height_px, &RenderSettings::shadow_map_px}) {
    RenderSettings settings;
    settings.width_px = settings.height_px = settings.shadow_map_px = 16;
    settings.shadows = ShadowMode::map;
    settings.*member = limit + 1;
    const std::string message = device_error([&] {
      GlRenderer(context(), gl::embedded_shaders(), scene, make_scene_facts(scene), Sheets(), settings, 1, nullptr,
                 pool);
    });
    EXPECT_NE(message.find("GL_MAX_TEXTURE_SIZE"), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(limit)), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace hybridrt
