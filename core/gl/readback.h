#pragma once

#include <memory>
#include <string>

#include "core/gl/objects.h"

namespace hybridrt::gl {

/// A texture's pixels on their way to the CPU, through a pixel buffer that stays mapped. Start it, do
/// something else, wait.
class Readback {
 public:
  /// `bytes`: size of the whole picture as it will be read.
  Readback(const Functions& gl, size_t bytes, const std::string& label);

  /// Queues the copy of mip level 0, rows tightly packed, layer after layer.
  void start(const TextureName& texture, GLenum format, GLenum type);

  /// Waits until the pixels are there. Throws Error(device) when the driver has not written them: a limit
  /// that is passed silently must not become a black frame.
  void wait();

  /// Valid after wait(), until the next start().
  const void* data() const { return mapped_; }

 private:
  const Functions* gl_;
  std::string label_;
  Buffer buffer_;
  const unsigned char* mapped_ = nullptr;
  std::unique_ptr<Fence> done_;
};

}  // namespace hybridrt::gl
