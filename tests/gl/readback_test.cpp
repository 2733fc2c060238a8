// Readback: pixels that the driver does not deliver are never taken for a picture.

#include "core/base/check.h"
#include "tests/gl/gl_test.h"

namespace hybridrt {
namespace {

class Readbacks : public GlTest {};

// A driver that delivers nothing leaves the sentinel, which must not become a picture. A texture full of the sentinel's
// bytes looks just the same.
TEST_F(Readbacks, UnwrittenPixelsThrow) {
  for (const uint32_t pixel : {0u, 0xFFFFFFFFu, 0xFEFEFEFEu}) {
    const gl::Texture texture(gl(), GL_R32UI, 4, 4, "texture");
    write_pixels(gl(), texture, 4, 4, GL_RED_INTEGER, GL_UNSIGNED_INT, std::vector<uint32_t>(16, pixel));
    const auto read = [&] { return read_pixels<uint32_t>(gl(), texture, 4, 4, GL_RED_INTEGER, GL_UNSIGNED_INT); };
    if (pixel == 0xFEFEFEFEu)
      EXPECT_THROW(read(), Error);
    else
      EXPECT_EQ(read(), std::vector<uint32_t>(16, pixel));
  }
}

TEST_F(Readbacks, CanBeReused) {
  const gl::Texture texture(gl(), GL_R8UI, 3, 5, "texture");
  gl::Readback readback(gl(), 15, "reused");
  for (uint8_t value : {1, 2, 3}) {
    write_pixels(gl(), texture, 3, 5, GL_RED_INTEGER, GL_UNSIGNED_BYTE, std::vector<uint8_t>(15, value));
    readback.start(texture, GL_RED_INTEGER, GL_UNSIGNED_BYTE);
    readback.wait();
    for (int i = 0; i < 15; ++i) EXPECT_EQ(static_cast<const uint8_t*>(readback.data())[i], value);
  }
}

/// A context's functions, but GetTextureImage loses its pixels without an error.
gl::Functions losing_pixels(gl::Functions gl) {
  gl.GetTextureImage = [](GLuint, GLint, GLenum, GLenum, GLsizei, void*) {};
  return gl;
}

// Pictures of a few bytes too: they are shorter than the part that is probed in others.
TEST_F(Readbacks, TheLastPictureIsNotTheNextOne) {
  for (int width = 1; width <= 9; ++width) {
    const gl::Texture texture(gl(), GL_R8UI, width, 1, "texture");
    write_pixels(gl(), texture, width, 1, GL_RED_INTEGER, GL_UNSIGNED_BYTE, std::vector<uint8_t>(width, 7));
    gl::Functions functions = gl();
    gl::Readback readback(functions, width, "test readback");
    readback.start(texture, GL_RED_INTEGER, GL_UNSIGNED_BYTE);
    readback.wait();
    functions = losing_pixels(gl());
    readback.start(texture, GL_RED_INTEGER, GL_UNSIGNED_BYTE);
    EXPECT_THROW(readback.wait(), Error) << width;
  }
}

// Nor is one that was refused, or never asked for.
TEST_F(Readbacks, AreWaitedForOnceAStart) {
  const gl::Texture texture(gl(), GL_R8UI, 4, 4, "texture");
  write_pixels(gl(), texture, 4, 4, GL_RED_INTEGER, GL_UNSIGNED_BYTE, std::vector<uint8_t>(16, 7));
  gl::Readback readback(gl(), 16, "test readback");
  EXPECT_THROW(readback.wait(), CheckFailed);
  readback.start(texture, GL_RED_INTEGER, GL_UNSIGNED_BYTE);
  EXPECT_THROW(readback.start(texture, GL_RED_INTEGER, GL_UNSIGNED_BYTE), CheckFailed);
  readback.wait();
  EXPECT_THROW(readback.wait(), CheckFailed);
  EXPECT_THROW(readback.start(texture, GL_RED_INTEGER, GL_FLOAT), Error);  // integers are not read as floats
  EXPECT_THROW(readback.wait(), CheckFailed);
}

}  // namespace
}  // namespace hybridrt
