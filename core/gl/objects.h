#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "core/gl/functions.h"

namespace hybridrt::gl {

/// One GL name: move-only, deleted with its owner. The Functions it was made with must outlive it.
/// `Deleter` is the member of Functions that deletes an array of names, or a single one.
template <auto Deleter>
class Handle {
 public:
  Handle() = default;
  Handle(const Functions& gl, GLuint id) : gl_(&gl), id_(id) {}
  Handle(Handle&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (!id_) return;
    if constexpr (requires { (gl_->*Deleter)(1, &id_); })
      (gl_->*Deleter)(1, &id_);
    else
      (gl_->*Deleter)(id_);
  }
  GLuint id() const { return id_; }

 protected:
  const Functions* gl_ = nullptr;
  GLuint id_ = 0;
};

using TextureName = Handle<&Functions::DeleteTextures>;

/// Immutable 2-D storage of one mip level, sampled with texelFetch (nearest, clamped). `label` shows up
/// in debuggers.
struct Texture : TextureName {
  Texture() = default;
  Texture(const Functions& gl, GLenum internal_format, int width_px, int height_px, const std::string& label);
};

/// Several textures of the same size, as layers.
struct TextureArray : TextureName {
  TextureArray() = default;
  /// Has at least one layer, even if `layers` is 0.
  TextureArray(const Functions& gl, GLenum internal_format, int width_px, int height_px, size_t layers,
               const std::string& label);
};

/// Immutable storage; `data` may be null. `flags` as glNamedBufferStorage takes them.
struct Buffer : Handle<&Functions::DeleteBuffers> {
  Buffer() = default;
  Buffer(const Functions& gl, size_t bytes, const void* data, GLbitfield flags, const std::string& label);
  size_t size_bytes = 0;
};

/// A buffer seen as a one-dimensional texture of `internal_format` (texelFetch on a samplerBuffer).
/// The buffer must outlive it.
struct BufferTexture : TextureName {
  BufferTexture() = default;
  BufferTexture(const Functions& gl, const Buffer& buffer, GLenum internal_format, const std::string& label);
};

struct Framebuffer : Handle<&Functions::DeleteFramebuffers> {
  Framebuffer() = default;
  /// Throws Error(device) if the framebuffer is incomplete. `color` may be null (depth only).
  Framebuffer(const Functions& gl, const Texture* color, const Texture& depth, const std::string& label);
};

/// Positions as attribute 0 (three floats, tightly packed) and 32-bit indices. The buffers must outlive it.
struct VertexArray : Handle<&Functions::DeleteVertexArrays> {
  VertexArray() = default;
  VertexArray(const Functions& gl, const Buffer& positions, const Buffer& indices, const std::string& label);
  /// One without attributes, for shaders that fetch what they need.
  VertexArray(const Functions& gl, const std::string& label);
};

/// A mark in the command stream that the CPU can wait for.
class Fence {
 public:
  explicit Fence(const Functions& gl);
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;
  ~Fence();
  /// Returns when all commands before the fence are done. Throws Error(device) if the driver gives up.
  void wait() const;

 private:
  const Functions& gl_;
  GLsync sync_;
};

}  // namespace hybridrt::gl
