#include "core/load/invisible.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/scene/textures.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

/// Under half a step of an 8-bit picture.
constexpr float kLeastOpacity = 1.f / 512;

bool is_all_holes(const Scene& scene, const Material& material) {
  if (!scene.textures || !scene.textures->has_holes(material.texture_maps)) return false;
  const std::vector<uint32_t>& words = scene.textures->words;
  const uint32_t* record = &words[words[material.texture_maps + HRT_MAP_HOLES]];
  const auto first = words.begin() + record[HRT_TEXTURE_FIRST];
  const auto texels = static_cast<std::ptrdiff_t>(uint64_t{record[HRT_TEXTURE_WIDTH]} * record[HRT_TEXTURE_HEIGHT]);
  return std::all_of(first, first + texels, [](uint32_t texel) { return texel >> 24 < 128; });
}

/// Why the surface shows nothing, or null where it shows something.
const char* reason_of(const Scene& scene, const Material& m) {
  if (is_all_holes(scene, m)) return "its texture is all holes";
  const bool seen = m.reflective() || m.ni != 1 || m.tf != vec3(1) || m.ke != vec3(0);
  if (seen) return nullptr;
  const bool shines = m.ks != vec3(0) && m.ns > 0;
  if (m.opacity < kLeastOpacity) return shines ? "d 0, at most its highlights are seen" : "d 0";
  if (m.transmit == vec3(1) && m.kd == vec3(0) && !shines) return "clear glass of Ni 1";
  return nullptr;
}

}  // namespace

void report_invisible(const Scene& scene, Warnings& warnings) {
  std::vector<size_t> triangles(scene.materials.size(), 0);
  for (uint32_t material : scene.triangle_materials) ++triangles[material];
  constexpr size_t kMostTold = 8;
  size_t told = 0, more = 0;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const char* reason = triangles[i] > 0 ? reason_of(scene, scene.materials[i]) : nullptr;
    if (!reason) continue;
    if (told++ < kMostTold)
      warnings.emplace_back(WarningCode::material_invisible,
                            fmt::format("material {}: all its {} triangles are invisible ({}); what is opaque goes "
                                        "into \"opaque\" of a scene JSON",
                                        in_quotes(scene.materials[i].name), triangles[i], reason));
    else
      ++more;
  }
  if (more > 0)
    warnings.emplace_back(WarningCode::material_invisible, fmt::format("{} more materials are invisible", more));
}

}  // namespace hybridrt
