#include "core/load/obj_writer.h"

#include <unordered_map>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/image/srgb.h"
#include "core/load/mtl_writer.h"
#include "core/load/written_line.h"

namespace hybridrt {
namespace {

class Geometry {
 public:
  Geometry(const Scene& scene, UpAxis up, OutputFile& file) : scene_(scene), up_(up), line_(file) {}

  void write(std::string_view mtl_name, std::span<const std::string> material_names) {
    line_.text("mtllib ").text(mtl_name).end();
    if (scene_.has_colors())
      write_colored_positions();
    else
      for (const vec3& p : scene_.positions) write_position(p).end();
    if (scene_.textures)
      for (const vec2& uv : scene_.textures->texcoords) line_.text("vt").vector(uv).end();
    for (const vec3& n : scene_.normals) line_.text("vn").vector(files_from_y_up(up_, n)).end();
    write_faces(material_names);
  }

 private:
  WrittenLine& write_position(const vec3& p) {
    const dvec3 origin = scene_.origin_world;
    line_.text("v");
    if (origin == dvec3(0)) return line_.vector(files_from_y_up(up_, p));
    return line_.vector(files_from_y_up(up_, dvec3(p) + origin));
  }

  /// A vertex for each pair of a position and a colour that a corner has, in the order of the corners.
  void write_colored_positions() {
    std::unordered_map<uint64_t, uint32_t> places;
    for (uint32_t t = 0; t < scene_.triangle_count(); ++t) {
      uvec3& vertices = colored_.emplace_back();
      for (int k = 0; k < 3; ++k) {
        const uint32_t position = scene_.triangle_positions[t][k], color = scene_.triangle_colors[t][k];
        const auto [place, is_new] =
            places.try_emplace(uint64_t{position} << 32 | color, static_cast<uint32_t>(places.size()));
        vertices[k] = place->second;
        if (!is_new) continue;
        const vec3& c = scene_.colors[color];
        write_position(scene_.positions[position])
            .vector(vec3(srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)))
            .end();
      }
    }
  }

  void write_faces(std::span<const std::string> material_names) {
    const std::vector<uvec3>& vertices = colored_.empty() ? scene_.triangle_positions : colored_;
    uint32_t material = kNoTriangle;  // none yet
    for (uint32_t t = 0; t < scene_.triangle_count(); ++t) {
      if (scene_.triangle_materials[t] != material) {
        material = scene_.triangle_materials[t];
        line_.text("usemtl ").text(material_names[material]).end();
      }
      const bool textured = scene_.textures && scene_.textures->triangle_maps[t] != 0;
      line_.text("f");
      for (int k = 0; k < 3; ++k) {
        line_.text(" ").number(vertices[t][k] + 1).text("/");
        if (textured) line_.number(scene_.textures->triangle_texcoords[t][k] + 1);
        line_.text("/").number(scene_.triangle_normals[t][k] + 1);
      }
      line_.end();
    }
  }

  const Scene& scene_;
  const UpAxis up_;
  WrittenLine line_;
  std::vector<uvec3> colored_;  ///< by triangle, the vertices written; empty: the scene's positions
};

}  // namespace

WrittenObj write_obj(const Scene& scene, const std::filesystem::path& path_obj, UpAxis up) {
  if (path_obj.extension() != ".obj")
    throw error(ErrorKind::usage, "{}: the name of an OBJ file ends in .obj", path_obj.string());
  WrittenObj written;
  written.mtl = path_obj;
  written.mtl.replace_extension(".mtl");
  const std::vector<std::string> names = distinct_names(scene.materials);
  OutputFile mtl(written.mtl);
  write_mtl(scene.materials, names, written.mtl.parent_path(), mtl);
  OutputFile obj(path_obj);
  Geometry(scene, up, obj).write(written.mtl.filename().string(), names);
  written.mtl_bytes = mtl.bytes(), written.obj_bytes = obj.bytes();
  mtl.commit();
  obj.commit();
  return written;
}

}  // namespace hybridrt
