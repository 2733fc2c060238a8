#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "core/gl/objects.h"

namespace hybridrt::gl {

/// File name -> text of every file in shaders/. They are embedded in the binary (embedded_shaders), or read from a
/// folder during development (load_shaders).
using ShaderSources = std::map<std::string, std::string, std::less<>>;

ShaderSources embedded_shaders();

/// Throws Error(input) when the folder or one of the embedded files' names in it cannot be read.
ShaderSources load_shaders(const std::string& folder);

/// The text of `name` with each `#include "FILE"` line replaced by that file, once. #line keeps line numbers in
/// messages right. Throws Error(device) naming a file that does not exist.
std::string expand_includes(const ShaderSources& sources, std::string_view name);

/// A linked program. File extensions tell the stages: .vert .frag .comp. Throws Error(device) with the driver's log.
class Program : public Handle<&Functions::DeleteProgram> {
 public:
  Program(const Functions& gl, const ShaderSources& sources, std::initializer_list<std::string_view> files);

  void use() const { gl_->UseProgram(id_); }
  const Functions& functions() const { return *gl_; }
  const std::string& name() const { return name_; }  ///< its file names

 private:
  std::string name_;
};

}  // namespace hybridrt::gl
