#include "core/gl/objects.h"

#include <algorithm>

#include "core/base/error.h"

namespace hybridrt::gl {
namespace {

template <typename Create, typename... Target>
GLuint create(Create function, Target... target) {
  GLuint id = 0;
  function(target..., 1, &id);
  return id;
}

void set_label(const Functions& gl, GLenum kind, GLuint id, const std::string& label) {
  gl.ObjectLabel(kind, id, static_cast<GLsizei>(label.size()), label.c_str());
}

void sample_nearest(const Functions& gl, GLuint texture) {
  gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

Texture::Texture(const Functions& gl, GLenum internal_format, int width_px, int height_px, const std::string& label)
    : Handle(gl, create(gl.CreateTextures, GL_TEXTURE_2D)) {
  set_label(gl, GL_TEXTURE, id_, label);
  gl.TextureStorage2D(id_, 1, internal_format, width_px, height_px);
  sample_nearest(gl, id_);
  throw_on_error(gl, ("creating " + label).c_str());
}

TextureArray::TextureArray(const Functions& gl, GLenum internal_format, int width_px, int height_px, size_t layers,
                           const std::string& label)
    : Handle(gl, create(gl.CreateTextures, GL_TEXTURE_2D_ARRAY)) {
  set_label(gl, GL_TEXTURE, id_, label);
  gl.TextureStorage3D(id_, 1, internal_format, width_px, height_px, static_cast<GLsizei>(std::max<size_t>(layers, 1)));
  sample_nearest(gl, id_);
  throw_on_error(gl, ("creating " + label).c_str());
}

Buffer::Buffer(const Functions& gl, size_t bytes, const void* data, GLbitfield flags, const std::string& label)
    : Handle(gl, create(gl.CreateBuffers)), size_bytes(bytes) {
  set_label(gl, GL_BUFFER, id_, label);
  gl.NamedBufferStorage(id_, static_cast<GLsizeiptr>(std::max<size_t>(bytes, 4)), bytes ? data : nullptr, flags);
  throw_on_error(gl, ("creating " + label).c_str());
}

BufferTexture::BufferTexture(const Functions& gl, const Buffer& buffer, GLenum internal_format,
                             const std::string& label)
    : Handle(gl, create(gl.CreateTextures, GL_TEXTURE_BUFFER)) {
  set_label(gl, GL_TEXTURE, id_, label);
  gl.TextureBuffer(id_, internal_format, buffer.id());
  throw_on_error(gl, ("creating " + label).c_str());
}

Framebuffer::Framebuffer(const Functions& gl, const Texture* color, const Texture& depth, const std::string& label)
    : Handle(gl, create(gl.CreateFramebuffers)) {
  set_label(gl, GL_FRAMEBUFFER, id_, label);
  if (color) gl.NamedFramebufferTexture(id_, GL_COLOR_ATTACHMENT0, color->id(), 0);
  gl.NamedFramebufferDrawBuffer(id_, color ? GL_COLOR_ATTACHMENT0 : GL_NONE);
  gl.NamedFramebufferReadBuffer(id_, color ? GL_COLOR_ATTACHMENT0 : GL_NONE);
  gl.NamedFramebufferTexture(id_, GL_DEPTH_ATTACHMENT, depth.id(), 0);
  const GLenum status = gl.CheckNamedFramebufferStatus(id_, GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw error(ErrorKind::device, "the driver refuses the framebuffer '{}' (status 0x{:04X})", label, status);
}

VertexArray::VertexArray(const Functions& gl, const Buffer& positions, const Buffer& indices, const std::string& label)
    : Handle(gl, create(gl.CreateVertexArrays)) {
  set_label(gl, GL_VERTEX_ARRAY, id_, label);
  gl.VertexArrayVertexBuffer(id_, 0, positions.id(), 0, 3 * sizeof(float));
  gl.VertexArrayElementBuffer(id_, indices.id());
  gl.EnableVertexArrayAttrib(id_, 0);
  gl.VertexArrayAttribFormat(id_, 0, 3, GL_FLOAT, GL_FALSE, 0);
  gl.VertexArrayAttribBinding(id_, 0, 0);
}

VertexArray::VertexArray(const Functions& gl, const std::string& label) : Handle(gl, create(gl.CreateVertexArrays)) {
  set_label(gl, GL_VERTEX_ARRAY, id_, label);
}

Fence::Fence(const Functions& gl) : gl_(gl), sync_(gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)) {}

Fence::~Fence() { gl_.DeleteSync(sync_); }

void Fence::wait() const {
  constexpr GLuint64 kOneSecond_ns = 1'000'000'000;
  for (;;) {
    const GLenum result = gl_.ClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, kOneSecond_ns);
    if (result == GL_ALREADY_SIGNALED || result == GL_CONDITION_SATISFIED) return;
    if (result != GL_TIMEOUT_EXPIRED) throw error(ErrorKind::device, "the driver failed while waiting for a frame");
  }
}

}  // namespace hybridrt::gl
