#include "core/load/obj_writer.h"

#include <charconv>

#include "core/base/error.h"
#include "core/base/output_file.h"

namespace hybridrt {
namespace {

/// One line of text, reused.
class Line {
 public:
  explicit Line(OutputFile& file) : file_(file) {}
  Line& text(std::string_view text) { return line_ += text, *this; }
  template <typename Number>
  Line& number(Number value) {
    char digits[32];
    const auto [end, status] = std::to_chars(digits, digits + sizeof digits, value);
    line_.append(digits, end);
    return *this;
  }
  Line& vector(std::string_view name, const vec3& v) {
    text(name);
    for (int axis = 0; axis < 3; ++axis) text(" ").number(v[axis]);
    return *this;
  }
  void end() {
    line_ += '\n';
    file_.write(line_);
    line_.clear();
  }

 private:
  OutputFile& file_;
  std::string line_;
};

void write_materials(const Scene& scene, Line line) {
  for (const Material& m : scene.materials) {
    line.text("newmtl ").text(m.name).end();
    line.vector("Kd", m.kd).end();
    line.vector("Ks", m.ks).end();
    line.vector("Ke", m.ke).end();
    line.text("Ns ").number(m.ns).end();
    line.text("Ni ").number(m.ni).end();
    line.text("d ").number(m.opacity).end();
    line.vector("Tf", m.tf).end();
    line.text("illum ").number(m.illum).end();
  }
}

void write_geometry(const Scene& scene, std::string_view mtl_name, Line line) {
  line.text("mtllib ").text(mtl_name).end();
  const dvec3 origin = scene.origin_world;
  for (const vec3& p : scene.positions) {
    if (origin == dvec3(0)) {
      line.vector("v", p).end();
      continue;
    }
    line.text("v");
    for (int axis = 0; axis < 3; ++axis) line.text(" ").number(p[axis] + origin[axis]);
    line.end();
  }
  for (const vec3& n : scene.normals) line.vector("vn", n).end();

  uint32_t material = kNoTriangle;  // none yet
  for (uint32_t t = 0; t < scene.triangle_count(); ++t) {
    if (scene.triangle_materials[t] != material) {
      material = scene.triangle_materials[t];
      line.text("usemtl ").text(scene.materials[material].name).end();
    }
    line.text("f");
    for (int k = 0; k < 3; ++k)
      line.text(" ").number(scene.triangle_positions[t][k] + 1).text("//").number(scene.triangle_normals[t][k] + 1);
    line.end();
  }
}

}  // namespace

WrittenObj write_obj(const Scene& scene, const std::filesystem::path& path_obj) {
  if (path_obj.extension() != ".obj")
    throw error(ErrorKind::usage, "{}: the name of an OBJ file ends in .obj", path_obj.string());
  WrittenObj written;
  written.mtl = path_obj;
  written.mtl.replace_extension(".mtl");
  OutputFile mtl(written.mtl);
  write_materials(scene, Line(mtl));
  OutputFile obj(path_obj);
  write_geometry(scene, written.mtl.filename().string(), Line(obj));
  written.mtl_bytes = mtl.bytes(), written.obj_bytes = obj.bytes();
  mtl.commit();
  obj.commit();
  return written;
}

}  // namespace hybridrt
