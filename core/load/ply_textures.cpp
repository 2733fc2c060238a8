#include "core/load/ply_textures.h"

#include "core/load/texture_finds.h"

namespace hybridrt {

std::vector<Material> texture_materials(const std::filesystem::path& ply, const std::vector<std::string>& files,
                                        Warnings& warnings) {
  TextureFinds finds({ply.parent_path()});
  std::vector<Material> materials;
  for (const std::string& file : files) {
    Material& material = materials.emplace_back();
    material.name = file, material.kd = vec3(1);
    TextureMap map;
    map.path = finds.find(file, 0);
    material.maps.push_back(std::move(map));
    resolve_material(material);
  }
  finds.report(ply, warnings);
  return materials;
}

}  // namespace hybridrt
