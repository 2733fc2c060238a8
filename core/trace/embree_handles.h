#pragma once

// Embree's objects, for the .cpp files of core/trace that use it.

#include <embree3/rtcore.h>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/base/math.h"

namespace hybridrt {

struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <typename Handle>
using EmbreeHandle = std::unique_ptr<std::remove_pointer_t<Handle>, ReleaseEmbree>;

/// The last error on `device` (null: on this thread, when there is no device) as an exception: Error (device),
/// std::bad_alloc.
void throw_on_embree_error(RTCDevice device, const char* doing);

/// Lends a mesh to the geometry, which must not outlive it. Embree reads 16 bytes of a position: they are copied where
/// the vector's memory ends with the last one (its capacity is its size). Throws as above.
void lend_triangles(RTCDevice device, RTCGeometry geometry, const std::vector<vec3>& positions,
                    const std::vector<uvec3>& triangles);

}  // namespace hybridrt
