#pragma once

// Embree's objects, for the .cpp files of core/trace that use it.

#include <embree3/rtcore.h>
#include <memory>
#include <span>
#include <type_traits>

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

/// Copies a mesh into the geometry's own buffers. Throws as above.
void fill_embree_triangles(RTCDevice device, RTCGeometry geometry, std::span<const vec3> positions,
                           std::span<const uvec3> triangles);

}  // namespace hybridrt
