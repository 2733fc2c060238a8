#pragma once

#include <memory>
#include <span>
#include <string>

#include "core/gl/objects.h"

namespace hybridrt::gl {

/// Copies a texture's pixels to the CPU through a pixel buffer that stays mapped. Start it, do something else, wait.
class Readback {
 public:
  /// `bytes`: size of all pixels that are read.
  Readback(const Functions& gl, size_t bytes, const std::string& label);

  /// Queues the copy of mip level 0, rows tightly packed, layer after layer.
  void start(const TextureName& texture, GLenum format, GLenum type);

  /// Waits until the pixels are there; call it once per start(). Throws Error(device) when the driver has not written
  /// them: a limit that the driver ignores silently must not become a black frame, or the previous one.
  void wait();

  /// Valid after wait(), until the next start().
  const void* data() const { return mapped_.data(); }

 private:
  const Functions* gl_;
  std::string label_;
  Buffer buffer_;
  std::span<unsigned char> mapped_;
  std::unique_ptr<Fence> done_;  ///< between start() and wait()
};

}  // namespace hybridrt::gl
