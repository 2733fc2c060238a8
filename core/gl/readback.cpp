#include "core/gl/readback.h"

#include <algorithm>

#include "core/base/error.h"

namespace hybridrt::gl {
namespace {

constexpr unsigned char kSentinel = 0xFE;  // no pixel that we read consists of such bytes
constexpr size_t kProbe_bytes = 4;

bool untouched(const unsigned char* bytes) {
  return std::all_of(bytes, bytes + kProbe_bytes, [](unsigned char byte) { return byte == kSentinel; });
}

}  // namespace

Readback::Readback(const Functions& gl, size_t bytes, const std::string& label)
    : gl_(&gl),
      label_(label),
      buffer_(gl, bytes, nullptr, GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT | GL_CLIENT_STORAGE_BIT,
              label) {
  mapped_ = static_cast<const unsigned char*>(
      gl.MapNamedBufferRange(buffer_.id(), 0, static_cast<GLsizeiptr>(std::max<size_t>(bytes, 4)),
                             GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT));
  if (!mapped_) throw error(ErrorKind::device, "{}: the driver cannot map a readback buffer of {} bytes", label, bytes);
}

void Readback::start(const TextureName& texture, GLenum format, GLenum type) {
  const Functions& gl = *gl_;
  gl.ClearNamedBufferSubData(buffer_.id(), GL_R8UI, 0, static_cast<GLsizeiptr>(buffer_.size_bytes), GL_RED_INTEGER,
                             GL_UNSIGNED_BYTE, &kSentinel);
  gl.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.id());
  gl.GetTextureImage(texture.id(), 0, format, type, static_cast<GLsizei>(buffer_.size_bytes), nullptr);
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl.MemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
  done_ = std::make_unique<Fence>(gl);
  throw_on_error(gl, label_.c_str());
}

void Readback::wait() {
  done_->wait();
  if (buffer_.size_bytes >= kProbe_bytes &&
      (untouched(mapped_) || untouched(mapped_ + buffer_.size_bytes - kProbe_bytes)))
    throw error(ErrorKind::device, "{}: the GL driver did not deliver the pixels; try a smaller picture", label_);
}

}  // namespace hybridrt::gl
