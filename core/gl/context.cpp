#include "core/gl/context.h"

#include <cstdlib>

#include "core/base/error.h"
#include "core/gl/context_backends.h"

namespace hybridrt::gl {
namespace {

/// What the environment tells Mesa and the loaders to do otherwise, as NAME=value.
std::string overrides() {
  std::string set;
  for (const char* name : {"MESA_GL_VERSION_OVERRIDE", "MESA_GLSL_VERSION_OVERRIDE", "GALLIUM_DRIVER",
                           "MESA_LOADER_DRIVER_OVERRIDE", "LIBGL_ALWAYS_SOFTWARE", "LIBGL_DRIVERS_PATH",
                           "__EGL_VENDOR_LIBRARY_FILENAMES", "__EGL_VENDOR_LIBRARY_DIRS", "EGL_PLATFORM"})
    if (const char* value = std::getenv(name)) set += fmt::format("{}{}={}", set.empty() ? "" : ", ", name, value);
  return set;
}

}  // namespace

void limit_software_threads(int threads) {
  // llvmpipe reads this once, when its screen is made; 0 makes it draw on the calling thread.
  setenv("LP_NUM_THREADS", threads == 1 ? "0" : std::to_string(threads).c_str(), 1);
}

std::vector<DeviceInfo> list_devices(const ContextRequest& request) {
  std::vector<DeviceInfo> devices;
  if (request.binding != Binding::osmesa && request.device != kOsmesaDevice) {
    std::string problem;
    devices = list_egl_devices(problem);
    if (!problem.empty()) devices.push_back({"egl", problem});
  }
  if (request.binding != Binding::egl) devices.push_back({kOsmesaDevice, ""});
  if (!request.device.empty())
    std::erase_if(devices, [&](const DeviceInfo& device) { return device.id != request.device; });
  return devices;
}

std::unique_ptr<Context> open_device(const DeviceInfo& device, bool require_hardware) {
  if (!device.problem.empty()) throw Error(ErrorKind::device, device.problem);
  std::unique_ptr<Context> context = device.id == kOsmesaDevice ? open_osmesa() : open_egl(device.id);
  if (context->info().software && require_hardware)
    throw error(ErrorKind::device, "{} is a software renderer", context->info().renderer);
  return context;
}

std::unique_ptr<Context> open_context(const ContextRequest& request) {
  std::vector<DeviceInfo> failed;
  for (const DeviceInfo& device : list_devices(request)) {
    try {
      return open_device(device, request.require_hardware);
    } catch (const Error& failure) {
      failed.push_back({device.id, failure.what()});
    }
  }
  throw no_usable_context(request, failed);
}

Error no_usable_context(const ContextRequest& request, const std::vector<DeviceInfo>& failed) {
  if (failed.empty() && !request.device.empty())
    return error(ErrorKind::device, "there is no GL device '{}'; 'hybridrt doctor' lists them", request.device);
  std::string tried;
  for (const DeviceInfo& device : failed)
    tried += fmt::format("{}{}: {}", tried.empty() ? "" : "; ", device.id, device.problem);
  if (const std::string set = overrides(); !set.empty())
    return error(
        ErrorKind::device,
        "no usable OpenGL 4.5 (tried {}) while the environment sets {}; unset it, or use --gl off, which needs "
        "no GL",
        tried, set);
  return error(ErrorKind::device,
               "no usable OpenGL 4.5 (tried {}); install a driver or Mesa (libegl1 libgl1-mesa-dri), or use --gl off, "
               "which needs none",
               tried);
}

void require_limit(const char* what, long long size, const char* limit_name, long long limit) {
  if (size > limit)
    throw error(ErrorKind::device, "{} of {} is more than this GL device's {} of {}", what, size, limit_name, limit);
}

}  // namespace hybridrt::gl
