// Mesa's off-screen software renderer. Upstream dropped it after 25.0, so it is opened at run time only.

#include <cstdint>

#include "core/gl/context_backends.h"
#include "core/gl/library.h"

namespace hybridrt::gl {
namespace {

// From GL/osmesa.h, which cannot be included here: it pulls in GL/gl.h, and that excludes glcorearb.h.
constexpr int kOsmesaFormat = 0x22, kOsmesaProfile = 0x33, kOsmesaCoreProfile = 0x34, kOsmesaMajor = 0x36,
              kOsmesaMinor = 0x37;
using OsmesaHandle = struct osmesa_context*;
using CreateContextAttribs = OsmesaHandle (*)(const int* attributes, OsmesaHandle share);
using MakeCurrent = GLboolean (*)(OsmesaHandle, void* buffer, GLenum type, GLsizei width, GLsizei height);
using DestroyContext = void (*)(OsmesaHandle);
using GetProcAddress = void* (*)(const char* name);

struct Osmesa {
  Library library{"libOSMesa.so.8"};
  CreateContextAttribs create_context = library.symbol<CreateContextAttribs>("OSMesaCreateContextAttribs");
  MakeCurrent make_current = library.symbol<MakeCurrent>("OSMesaMakeCurrent");
  DestroyContext destroy_context = library.symbol<DestroyContext>("OSMesaDestroyContext");
  GetProcAddress proc_address = library.symbol<GetProcAddress>("OSMesaGetProcAddress");
};

/// An OpenGL 4.5 core context, destroyed with its owner.
struct OwnContext {
  explicit OwnContext(const Osmesa& mesa_) : mesa(mesa_) {
    const int attributes[] = {
        kOsmesaFormat, GL_RGBA, kOsmesaProfile, kOsmesaCoreProfile, kOsmesaMajor, 4, kOsmesaMinor, 5, 0};
    context = mesa.create_context(attributes, nullptr);
    if (!context) throw Error(ErrorKind::device, "OSMesa cannot make an OpenGL 4.5 core context");
  }
  OwnContext(const OwnContext&) = delete;
  OwnContext& operator=(const OwnContext&) = delete;
  ~OwnContext() { mesa.destroy_context(context); }

  const Osmesa& mesa;
  OsmesaHandle context = nullptr;
};

/// `own` is this thread's context, from construction to destruction.
struct Current {
  explicit Current(const OwnContext& own_) : own(own_) {
    if (!own.mesa.make_current(own.context, screen, GL_UNSIGNED_BYTE, kScreenSize_px, kScreenSize_px))
      throw Error(ErrorKind::device, "OSMesa cannot make its context current");
  }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;
  ~Current() { own.mesa.make_current(nullptr, nullptr, 0, 0, 0); }

  // OSMesa wants a default framebuffer; we draw into our own instead.
  static constexpr int kScreenSize_px = 4;
  uint32_t screen[kScreenSize_px * kScreenSize_px];

  const OwnContext& own;
};

class OsmesaContext final : public Context {
 public:
  OsmesaContext() {
    functions_ = load_functions([&](const char* name) { return reinterpret_cast<void*>(mesa_.proc_address(name)); });
    info_ = inspect_current_context(functions_);
    info_.device = kOsmesaDevice;
    info_.binding = "OSMesa";
  }

 private:
  const Osmesa mesa_;
  const OwnContext own_{mesa_};
  Current current_{own_};
};

}  // namespace

std::unique_ptr<Context> open_osmesa() { return std::make_unique<OsmesaContext>(); }

}  // namespace hybridrt::gl
