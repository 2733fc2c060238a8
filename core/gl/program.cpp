#include "core/gl/program.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "core/base/check.h"
#include "core/base/error.h"

namespace hybridrt::gl {
namespace {

void append_file(const ShaderSources& sources, std::string_view name, std::set<std::string, std::less<>>& seen,
                 std::string& out) {
  if (!seen.emplace(name).second) return;
  const auto source = sources.find(name);
  if (source == sources.end()) throw error(ErrorKind::device, "there is no shader file '{}'", name);

  std::istringstream lines(source->second);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.starts_with("#include \"")) {
      const size_t end = line.rfind('"');
      append_file(sources, line.substr(10, end - 10), seen, out);
      out += fmt::format("#line {}\n", number + 1);
    } else {
      out += line;
      out += '\n';
      if (line.starts_with("#version")) out += fmt::format("#line {}\n", number + 1);
    }
  }
}

GLenum stage_of(std::string_view file) {
  if (file.ends_with(".vert")) return GL_VERTEX_SHADER;
  if (file.ends_with(".frag")) return GL_FRAGMENT_SHADER;
  HRT_CHECK(file.ends_with(".comp"));
  return GL_COMPUTE_SHADER;
}

/// A driver's log, which may have many lines, as one.
std::string one_line(std::string_view log) {
  std::string line;
  for (size_t begin = 0; begin < log.size();) {
    const size_t end = std::min(log.find_first_of("\r\n", begin), log.size());
    if (end > begin) line += (line.empty() ? "" : "; ") + std::string(log.substr(begin, end - begin));
    begin = end + 1;
  }
  return line;
}

using Shader = Handle<&Functions::DeleteShader>;

Shader compile(const Functions& gl, const ShaderSources& sources, std::string_view file) {
  const std::string text = expand_includes(sources, file);
  const char* data = text.c_str();
  Shader shader(gl, gl.CreateShader(stage_of(file)));
  gl.ShaderSource(shader.id(), 1, &data, nullptr);
  gl.CompileShader(shader.id());
  GLint ok = 0;
  gl.GetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
  if (ok) return shader;
  char log[4096] = "";
  gl.GetShaderInfoLog(shader.id(), sizeof log, nullptr, log);
  throw error(ErrorKind::device, "shader {} does not compile: {}", file, one_line(log));
}

}  // namespace

ShaderSources load_shaders(const std::string& folder) {
  constexpr std::string_view kEndings[] = {".vert", ".frag", ".comp", ".glsl", ".h"};
  ShaderSources sources;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    const bool is_shader = std::ranges::count(kEndings, entry.path().extension().string()) > 0;
    if (!is_shader || !entry.is_regular_file(failure)) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    sources[entry.path().filename().string()] = {std::istreambuf_iterator<char>(file), {}};
  }
  for (const auto& [name, text] : embedded_shaders())
    if (!sources.contains(name))
      throw error(
          ErrorKind::input,
          "--shaders {}: {} is missing or cannot be read; the folder must hold all of the program's shaders, or "
          "leave --shaders out",
          folder, name);
  return sources;
}

std::string expand_includes(const ShaderSources& sources, std::string_view name) {
  std::set<std::string, std::less<>> seen;
  std::string out;
  append_file(sources, name, seen, out);
  return out;
}

Program::Program(const Functions& gl, const ShaderSources& sources, std::initializer_list<std::string_view> files)
    : Handle(gl, gl.CreateProgram()) {
  for (std::string_view file : files) {
    const Shader shader = compile(gl, sources, file);
    gl.AttachShader(id_, shader.id());  // the program keeps it alive
    name_ += (name_.empty() ? "" : " + ") + std::string(file);
  }
  gl.LinkProgram(id_);
  GLint ok = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &ok);
  if (!ok) {
    char log[4096] = "";
    gl.GetProgramInfoLog(id_, sizeof log, nullptr, log);
    throw error(ErrorKind::device, "shaders {} do not link: {}", name_, one_line(log));
  }
  gl.ObjectLabel(GL_PROGRAM, id_, static_cast<GLsizei>(name_.size()), name_.c_str());
}

}  // namespace hybridrt::gl
