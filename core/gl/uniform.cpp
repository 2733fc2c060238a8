#include "core/gl/uniform.h"

#include "core/base/check.h"

namespace hybridrt::gl {
namespace {

void put(const Functions& gl, GLuint program, GLint location, int value) {
  gl.ProgramUniform1i(program, location, value);
}
void put(const Functions& gl, GLuint program, GLint location, float value) {
  gl.ProgramUniform1f(program, location, value);
}
void put(const Functions& gl, GLuint program, GLint location, const vec3& value) {
  gl.ProgramUniform3fv(program, location, 1, &value.x);
}
void put(const Functions& gl, GLuint program, GLint location, const mat4& value) {
  gl.ProgramUniformMatrix4fv(program, location, 1, GL_FALSE, &value[0].x);
}

}  // namespace

template <typename T>
Uniform<T>::Uniform(const Program& program, const std::string& name)
    : gl_(&program.functions()), program_(program.id()), location_(gl_->GetUniformLocation(program_, name.c_str())) {
  if (location_ < 0) throw CheckFailed(fmt::format("{} has no active uniform '{}'", program.name(), name));
}

template <typename T>
void Uniform<T>::set(const T& value) const {
  put(*gl_, program_, location_, value);
}

template class Uniform<int>;
template class Uniform<float>;
template class Uniform<vec3>;
template class Uniform<mat4>;

}  // namespace hybridrt::gl
