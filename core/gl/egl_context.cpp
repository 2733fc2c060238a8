// Contexts without a window through EGL: one device of EGL_EXT_device_enumeration, or Mesa's surfaceless
// platform. Every call goes through pointers from libEGL.so.1, opened at run time.

#define EGL_EGL_PROTOTYPES 0
#define EGL_EGLEXT_PROTOTYPES 0
#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "core/gl/context_backends.h"
#include "core/gl/extension_list.h"
#include "core/gl/library.h"

namespace hybridrt::gl {
namespace {

constexpr const char* kSurfaceless = "surfaceless";
constexpr int kMaxDevices = 64;

struct Egl {
  Library library{"libEGL.so.1"};
  PFNEGLGETPROCADDRESSPROC GetProcAddress = library.symbol<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress");
  PFNEGLQUERYSTRINGPROC QueryString = library.symbol<PFNEGLQUERYSTRINGPROC>("eglQueryString");
  PFNEGLGETERRORPROC GetError = library.symbol<PFNEGLGETERRORPROC>("eglGetError");
  PFNEGLINITIALIZEPROC Initialize = library.symbol<PFNEGLINITIALIZEPROC>("eglInitialize");
  PFNEGLBINDAPIPROC BindAPI = library.symbol<PFNEGLBINDAPIPROC>("eglBindAPI");
  PFNEGLCREATECONTEXTPROC CreateContext = library.symbol<PFNEGLCREATECONTEXTPROC>("eglCreateContext");
  PFNEGLDESTROYCONTEXTPROC DestroyContext = library.symbol<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext");
  PFNEGLMAKECURRENTPROC MakeCurrent = library.symbol<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");
  PFNEGLQUERYDEVICESEXTPROC QueryDevices = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceString =
      extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay =
      extension<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");

  template <typename FunctionPointer>
  FunctionPointer extension(const char* name) const {
    return reinterpret_cast<FunctionPointer>(GetProcAddress(name));
  }

  bool has(const char* client_extension) const {
    return lists_extension(QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), client_extension);
  }

  std::vector<EGLDeviceEXT> devices() const {
    if (!QueryDevices || !has("EGL_EXT_platform_device")) return {};
    EGLDeviceEXT found[kMaxDevices];
    EGLint count = 0;
    if (!QueryDevices(kMaxDevices, found, &count)) return {};
    return std::vector<EGLDeviceEXT>(found, found + count);
  }

  bool is_software(EGLDeviceEXT device) const {
    return QueryDeviceString && lists_extension(QueryDeviceString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
  }
};

[[noreturn]] void fail(const Egl& egl, const char* step) {
  throw error(ErrorKind::device, "{} failed (EGL error 0x{:04X})", step, egl.GetError());
}

/// An OpenGL 4.5 core context, destroyed with its owner.
struct OwnContext {
  OwnContext(const Egl& egl_, EGLDisplay display_) : egl(egl_), display(display_) {
    if (!egl.BindAPI(EGL_OPENGL_API)) fail(egl, "eglBindAPI(OpenGL)");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
#ifdef HYBRIDRT_GL_DEBUG
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 EGL_TRUE,
#endif
                                 EGL_NONE};
    context = egl.CreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) fail(egl, "creating an OpenGL 4.5 core context");
  }
  OwnContext(const OwnContext&) = delete;
  OwnContext& operator=(const OwnContext&) = delete;
  ~OwnContext() { egl.DestroyContext(display, context); }

  const Egl& egl;
  const EGLDisplay display;
  EGLContext context = EGL_NO_CONTEXT;
};

/// `own` is this thread's context, from construction to destruction.
struct Current {
  explicit Current(const OwnContext& own_) : own(own_) {
    if (!own.egl.MakeCurrent(own.display, EGL_NO_SURFACE, EGL_NO_SURFACE, own.context))
      fail(own.egl, "making the context current without a surface");
  }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;
  ~Current() { own.egl.MakeCurrent(own.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  const OwnContext& own;
};

class EglContext final : public Context {
 public:
  explicit EglContext(const std::string& device)
      : display_(initialised_display(device)), own_(egl_, display_), current_(own_) {
    functions_ = load_functions([&](const char* name) { return reinterpret_cast<void*>(egl_.GetProcAddress(name)); });
    info_ = inspect_current_context(functions_);
    info_.device = device;
    info_.binding = device == kSurfaceless ? "EGL surfaceless" : "EGL device";
  }

 private:
  /// It is never terminated: EGL returns the same display to every caller.
  EGLDisplay initialised_display(const std::string& device) const {
    const EGLDisplay display = display_of(device);
    if (display == EGL_NO_DISPLAY) throw Error(ErrorKind::device, "EGL gives no display for it");
    EGLint major = 0, minor = 0;
    if (!egl_.Initialize(display, &major, &minor)) fail(egl_, "eglInitialize");
    return display;
  }

  EGLDisplay display_of(const std::string& device) const {
    if (!egl_.GetPlatformDisplay) throw Error(ErrorKind::device, "this EGL has no platform displays");
    if (device == kSurfaceless)
      return egl_.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    const std::vector<EGLDeviceEXT> devices = egl_.devices();
    for (size_t i = 0; i < devices.size(); ++i)
      if (device == fmt::format("egl:{}", i))
        return egl_.GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
    throw Error(ErrorKind::device, "EGL lists no such device");
  }

  const Egl egl_;
  const EGLDisplay display_;
  const OwnContext own_;
  const Current current_;
};

/// A container often has the driver's libraries but not the file by which libglvnd finds them.
std::string no_device_hint() {
  return "EGL lists no device; an NVIDIA driver also needs its 10_nvidia.json in glvnd/egl_vendor.d "
         "(or named by __EGL_VENDOR_LIBRARY_FILENAMES)";
}

}  // namespace

std::vector<DeviceInfo> list_egl_devices(std::string& problem) try {
  const Egl egl;
  std::vector<DeviceInfo> hardware, software;
  const std::vector<EGLDeviceEXT> devices = egl.devices();
  for (size_t i = 0; i < devices.size(); ++i) {
    const bool is_software = egl.is_software(devices[i]);
    (is_software ? software : hardware).push_back({fmt::format("egl:{}", i), "", !is_software});
  }
  if (devices.empty()) problem = no_device_hint();
  hardware.insert(hardware.end(), software.begin(), software.end());
  if (egl.has("EGL_MESA_platform_surfaceless")) hardware.push_back({kSurfaceless, ""});
  return hardware;
} catch (const Error& no_library) {
  problem = no_library.what();
  return {};
}

std::unique_ptr<Context> open_egl(const std::string& device) { return std::make_unique<EglContext>(device); }

}  // namespace hybridrt::gl
