#include "core/load/ply_attributes.h"

#include <string>

#include "core/base/error.h"

namespace hybridrt {
namespace {

/// The index of the property with this name that is one number, or -1.
int find_number(const PlyElement& element, const std::string& name) {
  const int at = element.find(name);
  return at >= 0 && !element.properties[static_cast<size_t>(at)].is_list ? at : -1;
}

/// What means full brightness in numbers of this type; 0: as the numbers suggest.
float full_of(PlyType type) {
  switch (type) {
    case PlyType::uint8:
    case PlyType::int8: return 255;
    case PlyType::uint16: return 65535;
    default: return 0;
  }
}

}  // namespace

PlyColor find_color(const PlyElement& element) {
  constexpr const char* kNames[][4] = {{"red", "green", "blue", "alpha"},
                                       {"r", "g", "b", "a"},
                                       {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"}};
  PlyColor color;
  for (const auto& names : kNames) {
    color = {};
    for (size_t i = 0; i < 3; ++i) color.channels[i] = find_number(element, names[i]);
    color.alpha = find_number(element, names[3]);
    if (color.any()) break;
  }
  if (!color.complete()) return color;
  color.full = full_of(element.properties[static_cast<size_t>(color.channels[0])].type);
  for (const int channel : color.channels)
    if (full_of(element.properties[static_cast<size_t>(channel)].type) != color.full) color.full = 0;
  if (color.alpha >= 0) {
    const float full = full_of(element.properties[static_cast<size_t>(color.alpha)].type);
    color.full_alpha = full > 0 ? full : 1;
  }
  return color;
}

std::array<int, 2> find_texcoord(const PlyElement& element) {
  constexpr const char* kNames[][2] = {
      {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}, {"tex_u", "tex_v"}};
  for (const auto& names : kNames) {
    const std::array<int, 2> found{find_number(element, names[0]), find_number(element, names[1])};
    if (found[0] >= 0 && found[1] >= 0) return found;
  }
  return {-1, -1};
}

bool has_corner_texcoords(const PlyElement& element) {
  const int at = element.find("texcoord");
  return at >= 0 && element.properties[static_cast<size_t>(at)].is_list;
}

PlyVertexLayout vertex_layout(const PlyElement& element, bool textured, const std::filesystem::path& path,
                              Warnings& warnings) {
  constexpr const char* kNames[6] = {"x", "y", "z", "nx", "ny", "nz"};
  using Layout = PlyVertexLayout;
  Layout layout;
  layout.slots.assign(element.properties.size(), -1);
  const auto take = [&](int property, int number) {
    if (property >= 0) layout.slots[static_cast<size_t>(property)] = number;
    return property >= 0;
  };
  int known = 0;
  for (int i = 0; i < 6; ++i)
    if (const int at = element.find(kNames[i]); at >= 0 && !element.properties[static_cast<size_t>(at)].is_list)
      take(at, i), known |= 1 << i;
  if ((known & 7) != 7) throw error(ErrorKind::input, "{}: its vertices lack x, y or z", path.string());
  layout.has_normals = known == 63;

  layout.color = find_color(element);
  layout.has_color = layout.color.complete();
  if (layout.color.any() && !layout.has_color)
    warnings.emplace_back(
        WarningCode::color_ignored,
        path.filename().string() + ": vertex colours are ignored: not all of red, green, blue are there");
  for (int i = 0; i < 3 && layout.has_color; ++i) take(layout.color.channels[static_cast<size_t>(i)], Layout::kRed + i);
  layout.has_alpha = layout.has_color && take(layout.color.alpha, Layout::kAlpha);
  const std::array<int, 2> texcoord = find_texcoord(element);
  layout.has_texcoord = textured && texcoord[0] >= 0;
  for (int i = 0; i < 2 && layout.has_texcoord; ++i) take(texcoord[static_cast<size_t>(i)], Layout::kU + i);
  return layout;
}

}  // namespace hybridrt
