#include "core/gl/readback.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/base/error.h"

namespace hybridrt::gl {
namespace {

constexpr unsigned char kSentinel = 0xFE;  // no pixel that we read consists of these bytes only
constexpr size_t kProbe_bytes = 4;
constexpr GLbitfield kMapping = GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

// The bytes that tell whether pixels have arrived.
std::span<unsigned char> first(std::span<unsigned char> all) { return all.first(std::min(kProbe_bytes, all.size())); }
std::span<unsigned char> last(std::span<unsigned char> all) { return all.last(std::min(kProbe_bytes, all.size())); }

bool untouched(std::span<const unsigned char> bytes) {
  return std::ranges::all_of(bytes, [](unsigned char byte) { return byte == kSentinel; });
}

}  // namespace

Readback::Readback(const Functions& gl, size_t bytes, const std::string& label)
    : gl_(&gl), label_(label), buffer_(gl, bytes, nullptr, kMapping | GL_CLIENT_STORAGE_BIT, label) {
  void* mapped = gl.MapNamedBufferRange(buffer_.id(), 0, static_cast<GLsizeiptr>(std::max<size_t>(bytes, 4)), kMapping);
  if (!mapped) throw error(ErrorKind::device, "{}: the driver cannot map a readback buffer of {} bytes", label, bytes);
  mapped_ = {static_cast<unsigned char*>(mapped), bytes};
}

void Readback::start(const TextureName& texture, GLenum format, GLenum type) {
  const Functions& gl = *gl_;
  HRT_CHECK(!done_);
  // Written by the CPU: a driver that drops the copy would drop a clear as well, and leave the last picture.
  std::ranges::fill(first(mapped_), kSentinel);
  std::ranges::fill(last(mapped_), kSentinel);
  gl.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.id());
  gl.GetTextureImage(texture.id(), 0, format, type, static_cast<GLsizei>(buffer_.size_bytes), nullptr);
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl.MemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
  auto done = std::make_unique<Fence>(gl);
  throw_on_error(gl, label_.c_str());
  done_ = std::move(done);
}

void Readback::wait() {
  HRT_CHECK(done_);
  std::exchange(done_, nullptr)->wait();
  if (untouched(first(mapped_)) || untouched(last(mapped_)))
    throw error(ErrorKind::device, "{}: the GL driver did not deliver the pixels; try a smaller picture", label_);
}

}  // namespace hybridrt::gl
