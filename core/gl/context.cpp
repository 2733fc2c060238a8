#include "core/gl/context.h"

#include <cstdlib>

#include "core/base/error.h"
#include "core/gl/context_backends.h"

namespace hybridrt::gl {
namespace {

std::unique_ptr<Context> open_device(const std::string& id) {
  return id == kOsmesaDevice ? open_osmesa() : open_egl(id);
}

/// Every id that the request allows, best first.
std::vector<DeviceInfo> candidates(const ContextRequest& request) {
  std::vector<DeviceInfo> devices;
  if (request.binding != Binding::osmesa) {
    std::string problem;
    devices = list_egl_devices(problem);
    if (!problem.empty()) devices.push_back({"egl", problem});
  }
  if (request.binding != Binding::egl) devices.push_back({kOsmesaDevice, ""});
  return devices;
}

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

std::unique_ptr<Context> open_context(const ContextRequest& request) {
  std::string tried;
  bool known_device = request.device.empty();
  for (const DeviceInfo& device : candidates(request)) {
    if (!request.device.empty() && request.device != device.id) continue;
    known_device = true;
    try {
      if (!device.problem.empty()) throw Error(ErrorKind::device, device.problem);
      std::unique_ptr<Context> context = open_device(device.id);
      if (context->info().software && request.require_hardware)
        throw error(ErrorKind::device, "{} is a software renderer", context->info().renderer);
      return context;
    } catch (const Error& failure) {
      tried += fmt::format("{}{}: {}", tried.empty() ? "" : "; ", device.id, failure.what());
    }
  }
  if (!known_device)
    throw error(ErrorKind::device, "there is no GL device '{}'; 'hybridrt doctor' lists them", request.device);
  if (const std::string set = overrides(); !set.empty())
    throw error(ErrorKind::device,
                "no usable OpenGL 4.5 (tried {}) while the environment sets {}; unset it, or use "
                "--method raytrace, which needs no GL",
                tried, set);
  throw error(ErrorKind::device,
              "no usable OpenGL 4.5 (tried {}); install a driver or Mesa (libegl1 libgl1-mesa-dri), or use "
              "--method raytrace, which needs none",
              tried);
}

bool lists_hardware() { return lists_egl_hardware(); }

std::vector<ContextInfo> probe_devices(std::vector<DeviceInfo>& failed) {
  std::vector<ContextInfo> usable;
  for (DeviceInfo device : candidates({})) {
    try {
      if (!device.problem.empty()) throw Error(ErrorKind::device, device.problem);
      usable.push_back(open_device(device.id)->info());
    } catch (const Error& failure) {
      device.problem = failure.what();
      failed.push_back(device);
    }
  }
  return usable;
}

void require_limit(const char* what, long long size, const char* limit_name, long long limit) {
  if (size > limit)
    throw error(ErrorKind::device, "{} of {} is more than this GL device's {} of {}", what, size, limit_name, limit);
}

}  // namespace hybridrt::gl
