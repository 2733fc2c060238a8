#include "core/trace/embree_handles.h"

#include <algorithm>
#include <new>

#include "core/base/error.h"

namespace hybridrt {

void throw_on_embree_error(RTCDevice device, const char* doing) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE) return;
  if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw error(ErrorKind::device, "Embree failed while {} (error {}); use the kd-tree instead", doing,
              static_cast<int>(code));
}

void fill_embree_triangles(RTCDevice device, RTCGeometry geometry, std::span<const vec3> positions,
                           std::span<const uvec3> triangles) {
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  // Embree reads 16 bytes per vertex: its own buffers are padded for that, ours are not.
  auto* const vertices = static_cast<vec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), positions.size()));
  auto* const indices = static_cast<uvec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(uvec3), triangles.size()));
  throw_on_embree_error(device, "taking the triangles");
  std::copy(positions.begin(), positions.end(), vertices);
  std::copy(triangles.begin(), triangles.end(), indices);
}

}  // namespace hybridrt
