#include "core/load/ply_textures.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/load/ply_attributes.h"
#include "core/load/texture_finds.h"

namespace hybridrt {
namespace {

bool has_texcoords(const PlyHeader& header) {
  return std::any_of(header.elements.begin(), header.elements.end(), [](const PlyElement& element) {
    return (element.name == "vertex" && find_texcoord(element)[0] >= 0) ||
           (element.name == "face" && has_corner_texcoords(element));
  });
}

Material textured_material(const std::string& name, const std::filesystem::path& file) {
  Material material;
  material.name = name, material.kd = vec3(1);
  TextureMap map;
  map.path = file;
  material.maps.push_back(std::move(map));
  resolve_material(material);
  return material;
}

}  // namespace

std::vector<uint32_t> use_textures(const PlyHeader& header, MeshData& mesh, Warnings& warnings) {
  const std::string file = mesh.path.filename().string();
  const bool has_coordinates = has_texcoords(header);
  if (header.textures.empty() && has_coordinates)
    warnings.emplace_back(WarningCode::texcoord_unread,
                          file + ": texture coordinates were left out: no comment TextureFile names a texture");
  if (!header.textures.empty() && !has_coordinates)
    warnings.emplace_back(WarningCode::texture_without_texcoords,
                          fmt::format("{}: the texture {} was left out: there are no texture coordinates", file,
                                      in_quotes(header.textures[0].name)));
  if (header.textures.empty() || !has_coordinates) return {};

  TextureFinds finds({mesh.path.parent_path()});
  std::vector<uint32_t> numbers;
  for (const PlyTexture& texture : header.textures) {
    const auto known = std::find(mesh.material_names.begin() + 1, mesh.material_names.end(), texture.name);
    numbers.push_back(static_cast<uint32_t>(known - mesh.material_names.begin()));
    if (known != mesh.material_names.end()) continue;
    mesh.material_names.push_back(texture.name);
    mesh.materials.push_back(textured_material(texture.name, finds.find(texture.name, texture.line)));
  }
  finds.report(mesh.path, warnings);
  return numbers;
}

}  // namespace hybridrt
