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

void lend_triangles(RTCDevice device, RTCGeometry geometry, const std::vector<vec3>& positions,
                    const std::vector<uvec3>& triangles) {
  if (positions.capacity() > positions.size()) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(vec3), positions.size());
  } else {
    void* const own =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), positions.size());
    throw_on_embree_error(device, "taking the triangles");
    std::copy(positions.begin(), positions.end(), static_cast<vec3*>(own));
  }
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0, sizeof(uvec3),
                             triangles.size());
  throw_on_embree_error(device, "taking the triangles");
}

}  // namespace hybridrt
