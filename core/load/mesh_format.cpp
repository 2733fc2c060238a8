#include "core/load/mesh_format.h"

#include <string>

namespace hybridrt {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
  return mesh_format_of(path) != MeshFormat::obj || extension_of(path) == ".obj";
}

MeshFormat mesh_format_of(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".off") return MeshFormat::off;
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".om") return MeshFormat::om;
  return MeshFormat::obj;
}

}  // namespace hybridrt
