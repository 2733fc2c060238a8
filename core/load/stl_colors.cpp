#include "core/load/stl_colors.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "core/base/check.h"
#include "core/load/mesh_colors.h"

namespace hybridrt {
namespace {

constexpr float kFull = 31;
constexpr uint16_t kBit15 = 0x8000, kColorBits = 0x7FFF;

struct ObjectColor {
  vec3 color;  ///< 0 to kFull
  bool opaque = true;
};

std::optional<ObjectColor> object_color(std::string_view header) {
  constexpr std::string_view kKey = "COLOR=";
  const size_t at = header.find(kKey);
  if (at == header.npos || header.size() < at + kKey.size() + 4) return std::nullopt;
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(header[at + kKey.size() + i]); };
  return ObjectColor{vec3(byte(0), byte(1), byte(2)) * (kFull / 255), byte(3) == 255};
}

vec3 color_of(uint32_t bits, bool red_is_lowest) {
  const vec3 color(bits & 31, bits >> 5 & 31, bits >> 10 & 31);
  return red_is_lowest ? color : vec3(color.z, color.y, color.x);
}

}  // namespace

void take_stl_colors(std::string_view header, const std::vector<uint16_t>& attributes, MeshData& mesh,
                     Warnings& warnings) {
  HRT_CHECK_EQ(attributes.size(), mesh.triangle_positions.size());
  const std::optional<ObjectColor> object = object_color(header);
  const auto says_nothing = [](uint16_t attribute) { return attribute == 0; };
  const bool all_zero = std::all_of(attributes.begin(), attributes.end(), says_nothing);
  if (all_zero && !object) return;

  // All colours that facets can have, and behind them the object's: an index takes no search.
  constexpr uint32_t kObject = kColorBits + 1u;
  std::vector<uint32_t> places(kObject + 1, kNoIndex);
  for (const uint16_t attribute : attributes) {
    const bool has_bit = (attribute & kBit15) != 0;
    uint32_t color = attribute & kColorBits;
    if (object && (has_bit || all_zero)) color = kObject;
    if (!object && !has_bit) {
      mesh.triangle_colors.emplace_back(kNoIndex);
      continue;
    }
    if (places[color] == kNoIndex) {
      places[color] = static_cast<uint32_t>(mesh.colors.size());
      mesh.colors.push_back(color == kObject ? object->color : color_of(color, object.has_value()));
    }
    mesh.triangle_colors.emplace_back(places[color]);
  }
  mesh.color_full = kFull;
  if (mesh.colors.empty()) mesh.triangle_colors.clear();
  if (object && !object->opaque)
    warnings.emplace_back(WarningCode::color_alpha_unread,
                          mesh.path.filename().string() + ": the alpha of its colour is not read");
}

}  // namespace hybridrt
