#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "core/base/error.h"
#include "core/gl/context.h"
#include "core/gl/readback.h"

namespace hybridrt {

/// Opens and closes a context on every device.
inline std::vector<gl::ContextInfo> usable_devices(std::vector<gl::DeviceInfo>& failed) {
  std::vector<gl::ContextInfo> usable;
  for (gl::DeviceInfo device : gl::list_devices({})) {
    try {
      usable.push_back(gl::open_device(device, /*require_hardware=*/false)->info());
    } catch (const Error& failure) {
      device.problem = failure.what();
      failed.push_back(device);
    }
  }
  return usable;
}

/// A test with the best context of the machine; skipped, with the reason, if it has none.
class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = gl::open_context({});
    } catch (const Error& none) {
      GTEST_SKIP() << none.what();
    }
  }
  const gl::Context& context() const { return *context_; }
  const gl::Functions& gl() const { return context_->functions(); }

 private:
  std::unique_ptr<gl::Context> context_;
};

/// A texture's pixels, rows tightly packed, row 0 first, layer after layer.
template <typename Pixel>
std::vector<Pixel> read_pixels(const gl::Functions& gl, const gl::TextureName& texture, int width_px, int height_px,
                               GLenum format, GLenum type, size_t layers = 1) {
  std::vector<Pixel> pixels(layers * width_px * height_px);
  gl::Readback readback(gl, pixels.size() * sizeof(Pixel), "test readback");
  readback.start(texture, format, type);
  readback.wait();
  const Pixel* data = static_cast<const Pixel*>(readback.data());
  std::copy(data, data + pixels.size(), pixels.begin());
  return pixels;
}

template <typename Pixel>
void write_pixels(const gl::Functions& gl, const gl::Texture& texture, int width_px, int height_px, GLenum format,
                  GLenum type, const std::vector<Pixel>& pixels) {
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TextureSubImage2D(texture.id(), 0, 0, 0, width_px, height_px, format, type, pixels.data());
  gl::throw_on_error(gl, "test upload");
}

/// All layers of an array, one after the other.
template <typename Pixel>
void write_layers(const gl::Functions& gl, const gl::TextureArray& texture, int width_px, int height_px, GLenum format,
                  GLenum type, const std::vector<Pixel>& pixels) {
  const auto layers = static_cast<GLsizei>(pixels.size() / (static_cast<size_t>(width_px) * height_px));
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TextureSubImage3D(texture.id(), 0, 0, 0, 0, width_px, height_px, layers, format, type, pixels.data());
  gl::throw_on_error(gl, "test upload");
}

}  // namespace hybridrt
