#include "core/gl/functions.h"

#include "core/base/error.h"

namespace hybridrt::gl {

Functions load_functions(const std::function<void*(const char*)>& get_proc_address) {
  Functions gl;
#define HRT_GL_LOAD(TYPE, NAME)                                                \
  gl.NAME = reinterpret_cast<PFNGL##TYPE##PROC>(get_proc_address("gl" #NAME)); \
  if (!gl.NAME) throw error(ErrorKind::device, "the driver lacks gl{}, part of OpenGL 4.5", #NAME);
  HRT_GL_FUNCTIONS(HRT_GL_LOAD)
#undef HRT_GL_LOAD
  return gl;
}

void throw_on_error(const Functions& gl, const char* where) {
  const GLenum code = gl.GetError();
  if (code == GL_NO_ERROR) return;
  if (code == GL_OUT_OF_MEMORY)
    throw error(ErrorKind::device, "{}: out of GPU memory; render a smaller picture, shadow map or scene", where);
  throw error(ErrorKind::device, "{}: OpenGL error 0x{:04X}", where, code);
}

}  // namespace hybridrt::gl
