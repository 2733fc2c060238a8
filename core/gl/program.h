#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "core/gl/objects.h"

namespace hybridrt::gl {

/// File name -> text of everything in shaders/. Shader files are compiled into the program
/// (embedded_shaders) or read from a folder while they are being worked on (load_shaders).
using ShaderSources = std::map<std::string, std::string, std::less<>>;

ShaderSources embedded_shaders();

/// Throws Error(input) when the folder cannot be read.
ShaderSources load_shaders(const std::string& folder);

/// The text of `name` with each `#include "FILE"` line replaced by that file, once. The lines keep
/// their numbers in messages by #line. Throws Error(device) naming a file that does not exist.
std::string expand_includes(const ShaderSources& sources, std::string_view name);

/// A linked program. Stages by extension: .vert .frag .comp. Throws Error(device) with the driver's log.
class Program : public Handle<&Functions::DeleteProgram> {
 public:
  Program(const Functions& gl, const ShaderSources& sources, std::initializer_list<std::string_view> files);

  void use() const { gl_->UseProgram(id_); }
  const Functions& functions() const { return *gl_; }
  const std::string& name() const { return name_; }  ///< its files

 private:
  std::string name_;
};

}  // namespace hybridrt::gl
