#pragma once

#include <memory>
#include <span>

#include "core/base/parallel.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"

namespace hybridrt {

class EmbreeScene;

/// The baseline for triangle ids: primary rays by Embree alone, in packets of neighbouring pixels.
class EmbreePrimary {
 public:
  EmbreePrimary(const Scene& scene, int threads, bool robust);
  ~EmbreePrimary();

  /// `packet`: rays in a packet, 4, 8 or 16; 0: streams of 256 rays. `ids`: one element per pixel.
  void find(const View& view, int packet, ThreadPool& pool, std::span<uint32_t> ids) const;

 private:
  std::unique_ptr<EmbreeScene> scene_;
};

}  // namespace hybridrt
