#pragma once

#include "core/gl/context.h"

// The bindings behind open_context(). Each opener throws Error(device) with the reason in one clause.
namespace hybridrt::gl {

/// Ids "egl:N" in EGL's own order, then "surfaceless"; empty when there is no libEGL (`problem` says so).
std::vector<DeviceInfo> list_egl_devices(std::string& problem);
std::unique_ptr<Context> open_egl(const std::string& device);

inline constexpr const char* kOsmesaDevice = "osmesa";
std::unique_ptr<Context> open_osmesa();

/// Reads version, strings and limits of the current context; throws below OpenGL 4.5 core. In builds
/// with HYBRIDRT_GL_DEBUG also installs a callback that records messages for throw_on_error.
ContextInfo inspect_current_context(const Functions& gl);

}  // namespace hybridrt::gl
