#pragma once

#include <string>

#include "core/base/math.h"
#include "core/gl/program.h"

namespace hybridrt::gl {

/// A uniform of a program, looked up once. `T`: int, float, vec3 or mat4. The program must outlive it.
template <typename T>
class Uniform {
 public:
  /// Throws CheckFailed for a name that the program does not use: it is always our mistake.
  Uniform(const Program& program, const std::string& name);
  void set(const T& value) const;

 private:
  const Functions* gl_;
  GLuint program_;
  GLint location_;
};

}  // namespace hybridrt::gl
