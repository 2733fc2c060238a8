#pragma once

#include "core/load/mesh_builder.h"
#include "core/load/mesh_colors.h"
#include "core/load/ply_attributes.h"
#include "core/load/ply_lists.h"

namespace hybridrt {

/// Reads what the faces of an element have beside their corners: colour, texcoord (two numbers a corner), texnumber.
template <typename Values>
class FaceExtrasReader {
 public:
  /// `texture_materials`: as use_textures() returns them; they, `values` and `element` must outlive the reader.
  FaceExtrasReader(Values& values, const PlyElement& element, const std::vector<uint32_t>& texture_materials,
                   MeshBuilder& mesh, Warnings& warnings)
      : values_(values), element_(element), texture_materials_(texture_materials), mesh_(mesh) {
    if (!texture_materials.empty()) texnumber_ = element.find("texnumber");
    if (!texture_materials.empty() && has_corner_texcoords(element)) texcoord_ = element.find("texcoord");
    color_ = find_color(element);
    if (color_.any() && !color_.complete())
      warnings.emplace_back(
          WarningCode::color_ignored,
          mesh.data.path.filename().string() + ": face colours are ignored: not all of red, green, blue are there");
    if (color_.complete())
      mesh.face_color_full = color_.full;
    else
      color_ = {};
  }

  /// A face is begun, its properties but the list of corners are read, and it is finished.
  void begin() { numbers_.clear(), rgb_ = dvec3(0), texture_ = 0; }

  void read(size_t index, uint64_t face) {
    const PlyProperty& property = element_.properties[index];
    const auto p = static_cast<int>(index);
    if (p == texcoord_) {
      numbers_.resize(list_length(values_, property, mesh_, face));
      for (double& number : numbers_) number = values_.next(property.type);
      return;
    }
    if (property.is_list) return skip(values_, property, mesh_, face);
    const double number = values_.next(property.type);
    for (int i = 0; i < 3; ++i)
      if (p == color_.channels[static_cast<size_t>(i)]) rgb_[i] = number;
    if (p == color_.alpha) mesh_.add_alpha(number, color_.full_alpha, values_.place(face));
    if (p == texnumber_) texture_ = number;
  }

  /// Valid until the next face.
  MeshBuilder::FaceExtras finish(size_t corners, size_t place) {
    MeshBuilder::FaceExtras extras;
    if (color_.complete()) extras.color = mesh_.add_face_color(color_of_numbers(rgb_));
    if (texture_materials_.empty()) return extras;
    const bool known = texture_ >= 0 && texture_ < static_cast<double>(texture_materials_.size());
    extras.material = known ? texture_materials_[static_cast<size_t>(texture_)] : 0;
    if (!known) unknown_textures_.add(place);
    if (numbers_.size() != 2 * corners) return extras;
    texcoords_.clear();
    for (size_t i = 0; i < corners; ++i) {
      texcoords_.push_back(static_cast<uint32_t>(mesh_.data.texcoords.size()));
      mesh_.add_texcoord({numbers_[2 * i], numbers_[2 * i + 1]}, place);
    }
    extras.texcoords = texcoords_;
    return extras;
  }

  void report_unknown(Warnings& warnings) const {
    hybridrt::report(WarningCode::texture_unknown, unknown_textures_,
                     "faces have a texnumber that no TextureFile comment has, and no texture", mesh_.data.path,
                     warnings, mesh_.data.place);
  }

 private:
  Values& values_;
  const PlyElement& element_;
  const std::vector<uint32_t>& texture_materials_;
  MeshBuilder& mesh_;
  int texcoord_ = -1, texnumber_ = -1;
  PlyColor color_;
  std::vector<double> numbers_;      // of this face's texcoord
  std::vector<uint32_t> texcoords_;  // kept to reuse memory
  dvec3 rgb_{0};
  double texture_ = 0;
  Tally unknown_textures_;
};

}  // namespace hybridrt
