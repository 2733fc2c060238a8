#pragma once

#include <embree3/rtcore.h>

#include "core/scene/scene.h"

namespace hybridrt {

/// A scene's triangles in Embree's tree of the highest quality, as a plain program on top of Embree would build it.
class EmbreeScene {
 public:
  EmbreeScene(const Scene& scene, int threads, bool robust);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCScene get() const { return scene_; }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace hybridrt
