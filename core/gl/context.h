#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/gl/functions.h"

namespace hybridrt::gl {

/// Which binding of OpenGL to use; none needs a window system.
enum class Binding { any, egl, osmesa };

struct ContextRequest {
  Binding binding = Binding::any;
  std::string device;             ///< an id as list_devices() gives it; empty: the best
  bool require_hardware = false;  ///< refuse software renderers
};

/// Facts about an open context.
struct ContextInfo {
  std::string device;   ///< id: "egl:0", "surfaceless", "osmesa"
  std::string binding;  ///< "EGL device", "EGL surfaceless", "OSMesa"
  std::string vendor, renderer, version;
  bool software = false;
  int max_texture_px = 0;     ///< GL_MAX_TEXTURE_SIZE
  int max_buffer_texels = 0;  ///< GL_MAX_TEXTURE_BUFFER_SIZE
};

/// What a device is before a context is opened on it; `problem` says why it cannot be used.
struct DeviceInfo {
  std::string id, problem;
  bool listed_as_hardware = false;  ///< by EGL itself
};

/// An OpenGL 4.5 core context without a window, current on the thread that made it until it is destroyed.
class Context {
 public:
  virtual ~Context() = default;
  const Functions& functions() const { return functions_; }
  const ContextInfo& info() const { return info_; }

 protected:
  Context() = default;
  Functions functions_;
  ContextInfo info_;
};

/// Limits a software renderer's own threads, in all contexts of this process. This sets an environment variable, which
/// other threads may be reading: call it before the program starts its first thread and opens a context.
void limit_software_threads(int threads);

/// Opens the best context that the request allows: EGL devices (hardware first), EGL surfaceless, OSMesa. A driver that
/// crashes takes this process with it: device_probe.h finds out before.
/// Throws Error(device) that says what was tried and how each failed.
std::unique_ptr<Context> open_context(const ContextRequest& request);

/// Every device that the request allows, best first. Opens none, but loads EGL with its vendors' libraries.
std::vector<DeviceInfo> list_devices(const ContextRequest& request);

/// Throws Error(device) with the reason in one clause.
std::unique_ptr<Context> open_device(const DeviceInfo& device, bool require_hardware);

/// The Error(device) for a request that nothing satisfies: what was tried and how it failed, what to do.
Error no_usable_context(const ContextRequest& request, const std::vector<DeviceInfo>& failed);

/// Throws Error(device) naming the limit if `size` of `what` is more than `limit`.
void require_limit(const char* what, long long size, const char* limit_name, long long limit);

}  // namespace hybridrt::gl
