#include <cstdio>

#include "core/base/error.h"
#include "core/gl/context_backends.h"

namespace hybridrt::gl {
namespace {

std::string text(const Functions& gl, GLenum name) {
  const GLubyte* value = gl.GetString(name);
  return value ? reinterpret_cast<const char*>(value) : "?";
}

bool is_software(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR", "Software"})
    if (renderer.find(name) != std::string::npos) return true;
  return false;
}

int integer(const Functions& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

#ifdef HYBRIDRT_GL_DEBUG
void APIENTRY print_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message, const void*) {
  if (type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH)
    std::fprintf(stderr, "OpenGL: %s\n", message);  // glGetError at the pass's end throws
}
#endif

}  // namespace

ContextInfo inspect_current_context(const Functions& gl) {
  ContextInfo info;
  info.vendor = text(gl, GL_VENDOR);
  info.renderer = text(gl, GL_RENDERER);
  info.version = text(gl, GL_VERSION);
  info.software = is_software(info.renderer);
  const int major = integer(gl, GL_MAJOR_VERSION), minor = integer(gl, GL_MINOR_VERSION);
  if (major * 10 + minor < 45)
    throw error(ErrorKind::device, "{} offers OpenGL {}.{}, 4.5 is needed", info.renderer, major, minor);
  info.max_texture_px = integer(gl, GL_MAX_TEXTURE_SIZE);
  info.max_buffer_texels = integer(gl, GL_MAX_TEXTURE_BUFFER_SIZE);
#ifdef HYBRIDRT_GL_DEBUG
  gl.Enable(GL_DEBUG_OUTPUT);
  gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  gl.DebugMessageCallback(print_message, nullptr);
#endif
  return info;
}

}  // namespace hybridrt::gl
