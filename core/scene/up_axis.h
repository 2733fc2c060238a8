#pragma once

#include "core/base/math.h"
#include "core/base/named.h"

namespace hybridrt {

/// Which axis of a scene's files points up. Everything after loading has y up.
enum class UpAxis { y, z };
inline constexpr Named<UpAxis> kUpAxes[] = {{"y", UpAxis::y}, {"z", UpAxis::z}};

/// Turns a point or direction from the files' axes to the loaded scene's: (x, y, z) -> (x, z, -y) where z is up, a
/// quarter turn about x that is exact. A user's numbers for a scene (a camera, a light) are in the axes of its files
/// and are turned too.
template <typename Real>
[[nodiscard]] Vec3<Real> y_up_from_files(UpAxis up, const Vec3<Real>& v) {
  return up == UpAxis::y ? v : Vec3<Real>(v.x, v.z, -v.y);
}

/// The way back, as exact: to the axes of files where `up` points up.
template <typename Real>
[[nodiscard]] Vec3<Real> files_from_y_up(UpAxis up, const Vec3<Real>& v) {
  return up == UpAxis::y ? v : Vec3<Real>(v.x, -v.z, v.y);
}

}  // namespace hybridrt
