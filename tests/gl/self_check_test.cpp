#include "core/gl/self_check.h"

#include "tests/gl/gl_test.h"

namespace hybridrt {
namespace {

class SelfCheck : public GlTest {};

TEST_F(SelfCheck, EveryDeviceOfThisMachineDrawsRight) {
  for (const gl::DeviceInfo& device : gl::list_devices({})) {
    std::unique_ptr<gl::Context> opened;
    try {
      opened = gl::open_device(device, false);
    } catch (const Error&) {
      continue;
    }
    EXPECT_NO_THROW(gl::require_right_answers(*opened)) << device.id;
  }
}

/// A context whose entry points a test may replace.
class Faulty : public gl::Context {
 public:
  explicit Faulty(const gl::Context& right) {
    functions_ = right.functions();
    info_ = right.info();
  }
  gl::Functions& faulty() { return functions_; }
};

std::string complaint(const gl::Context& context) {
  try {
    gl::require_right_answers(context);
  } catch (const Error& wrong) {
    EXPECT_EQ(wrong.kind(), ErrorKind::device);
    return wrong.what();
  }
  return "";
}

// Each is what some driver has done: commands that are swallowed, depth that is ignored or turned round.
TEST_F(SelfCheck, WrongPicturesAreNoticed) {
  const auto with = [&](const auto& plant) {
    const std::unique_ptr<gl::Context> fresh = gl::open_context({});
    Faulty context(*fresh);
    plant(context.faulty());
    return complaint(context);
  };
  EXPECT_EQ(with([](gl::Functions&) {}), "");
  EXPECT_NE(with([](gl::Functions& f) { f.DrawArrays = [](GLenum, GLint, GLsizei) {}; }).find("triangle id"),
            std::string::npos);
  EXPECT_NE(with([](gl::Functions& f) { f.DispatchCompute = [](GLuint, GLuint, GLuint) {}; }).find("computed"),
            std::string::npos);
  EXPECT_NE(with([](gl::Functions& f) { f.DepthFunc = [](GLenum) {}; }), "");
  EXPECT_NE(with([](gl::Functions& f) { f.ClipControl = [](GLenum, GLenum) {}; }), "");
  EXPECT_NE(with([](gl::Functions& f) {
              f.BindImageTexture = [](GLuint, GLuint, GLint, GLboolean, GLint, GLenum, GLenum) {};
            }),
            "");
}

}  // namespace
}  // namespace hybridrt
