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

class OsmesaContext final : public Context {
 public:
  OsmesaContext() {
    const int attributes[] = {
        kOsmesaFormat, GL_RGBA, kOsmesaProfile, kOsmesaCoreProfile, kOsmesaMajor, 4, kOsmesaMinor, 5, 0};
    context_ = create_(attributes, nullptr);
    if (!context_) throw Error(ErrorKind::device, "OSMesa cannot make an OpenGL 4.5 core context");
    if (!make_current_(context_, screen_, GL_UNSIGNED_BYTE, kScreenSize_px, kScreenSize_px)) {
      destroy_(context_);
      throw Error(ErrorKind::device, "OSMesa cannot make its context current");
    }
    functions_ = load_functions([&](const char* name) { return reinterpret_cast<void*>(proc_address_(name)); });
    info_ = inspect_current_context(functions_);
    info_.device = kOsmesaDevice;
    info_.binding = "OSMesa";
  }

  ~OsmesaContext() override {
    make_current_(nullptr, nullptr, 0, 0, 0);
    destroy_(context_);
  }

 private:
  // OSMesa wants a default framebuffer; everything is drawn into our own ones.
  static constexpr int kScreenSize_px = 4;
  uint32_t screen_[kScreenSize_px * kScreenSize_px];

  Library library_{"libOSMesa.so.8"};
  CreateContextAttribs create_ = library_.symbol<CreateContextAttribs>("OSMesaCreateContextAttribs");
  MakeCurrent make_current_ = library_.symbol<MakeCurrent>("OSMesaMakeCurrent");
  DestroyContext destroy_ = library_.symbol<DestroyContext>("OSMesaDestroyContext");
  GetProcAddress proc_address_ = library_.symbol<GetProcAddress>("OSMesaGetProcAddress");
  OsmesaHandle context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> open_osmesa() { return std::make_unique<OsmesaContext>(); }

}  // namespace hybridrt::gl
