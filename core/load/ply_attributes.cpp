#include "core/load/ply_attributes.h"

#include <string>

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

}  // namespace hybridrt
