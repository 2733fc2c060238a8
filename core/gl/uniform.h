#pragma once

#include <string>

#include "core/base/math.h"
#include "core/gl/program.h"

namespace hybridrt::gl {

/// A uniform of a program, found once, then only set. `T`: int, float, vec3 or mat4. The program must outlive it.
template <typename T>
class Uniform {
 public:
  /// A name that the program does not use is an error (CheckFailed): it is always our mistake.
  Uniform(const Program& program, const std::string& name);
  void set(const T& value) const;

 private:
  const Functions* gl_;
  GLuint program_;
  GLint location_;
};

}  // namespace hybridrt::gl
