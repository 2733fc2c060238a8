#include "core/load/mtl_io.h"

#include <algorithm>
#include <optional>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/find_file.h"
#include "core/load/mtl_opacity.h"
#include "core/load/text_lines.h"
#include "core/load/text_scan.h"
#include "core/load/texture_finds.h"
#include "core/load/texture_name.h"

namespace hybridrt {
namespace {

/// A statement: its place, and what is left of it to read.
struct Statement {
  const TextLines& lines;
  std::string_view name, rest;
};

float take_number(Statement& s) {
  const std::string_view word = take_word(s.rest);
  const std::optional<double> number = parse_number(word);
  const std::string where = fmt::format("{}:{}: {}", s.lines.path().string(), s.lines.line_number(), s.name);
  if (word.empty()) throw error(ErrorKind::input, "{} has no number after it; fix or remove that line", where);
  if (!number || std::abs(*number) > 1e30)
    throw error(ErrorKind::input, "{}: {} is not a usable number; fix or remove that line", where, in_quotes(word));
  return static_cast<float>(*number);
}

/// One number or three, clamped to >= 0. False for spectral and xyz colours, which we do not read.
bool take_color(Statement& s, vec3& color) {
  std::string_view peek = s.rest;
  const std::string_view first = take_word(peek);
  if (first == "spectral" || first == "xyz") return false;
  vec3 value(take_number(s));
  if (!trimmed(s.rest).empty()) value.y = take_number(s), value.z = take_number(s);
  color = glm::max(value, vec3(0));
  return true;
}

/// `keyword` in lower case.
bool names_a_texture(std::string_view keyword) {
  return keyword.starts_with("map_") || keyword == "bump" || keyword == "disp" || keyword == "decal" ||
         keyword == "refl" || keyword == "norm";
}

/// The kind of map, for maps that we read.
std::optional<MapKind> map_kind(std::string_view keyword) {
  if (keyword == "map_kd") return MapKind::diffuse;
  if (keyword == "map_ks") return MapKind::specular;
  if (keyword == "map_ke") return MapKind::emitted;
  if (keyword == "map_d") return MapKind::holes;
  return std::nullopt;
}

struct Tallies {
  Tally unread_kinds, foreign_colors, bad_ni, bad_illum;
  NameList large_colors, tr_ignored, illum_ignored;
};

constexpr float kDefaultExponent = 30;  // of a Ks without Ns; 0 would be no highlight
constexpr float kLargestColor = 1.5f;   // beyond, it is hardly meant as a share of the light

struct Reading {
  Reading() { material.ns = kDefaultExponent; }

  Material material;
  MtlOpacity opacity;
  bool has_ks = false, has_ke = false;
};

/// Keeps the texture; counts what is wrong with its name.
void read_texture(const Statement& s, const std::string& keyword, TextureFinds& files, Reading& reading,
                  Tallies& tallies) {
  const std::optional<MapKind> kind = map_kind(keyword);
  std::vector<TextureMap>& maps = reading.material.maps;
  if (kind) std::erase_if(maps, [&](const TextureMap& map) { return map.kind == *kind; });  // the last of a kind counts
  TextureStatement texture = read_texture_statement(s.rest);
  if (texture.name.empty()) return;

  const size_t line = s.lines.line_number();
  const std::filesystem::path& file = files.find(texture.name, line, kind.has_value());
  if (!kind && keyword != "map_ka") tallies.unread_kinds.add(line);  // Ka itself does not count
  if (!kind) return;
  texture.map.kind = *kind;
  texture.map.path = file;
  maps.push_back(std::move(texture.map));
}

void read_statement(Statement& s, TextureFinds& files, Reading& reading, Tallies& tallies) {
  Material& m = reading.material;
  const size_t line = s.lines.line_number();
  const auto color = [&](vec3& to) {
    const bool read = take_color(s, to);
    if (!read) tallies.foreign_colors.add(line);
    return read;
  };
  if (s.name == "Kd") return reading.opacity.has_kd = true, void(color(m.kd));
  if (s.name == "Ks") return reading.has_ks = true, void(color(m.ks));
  if (s.name == "Ke") return reading.has_ke = true, void(color(m.ke));
  if (s.name == "Tf") return void(reading.opacity.filters = !color(m.tf) || m.tf != vec3(1));
  if (s.name == "Ns") {
    m.ns = std::clamp(take_number(s), 0.f, 1e4f);
  } else if (s.name == "Ni") {
    m.ni = take_number(s);
    if (m.ni <= 0) m.ni = 1, tallies.bad_ni.add(line);
  } else if (s.name == "d") {
    std::string_view peek = s.rest;
    if (take_word(peek) == "-halo") s.rest = peek;  // -halo fades with the angle; we take the plain factor
    reading.opacity.dissolve = std::clamp(take_number(s), 0.f, 1.f);
  } else if (s.name == "Tr") {
    reading.opacity.transparency = std::clamp(take_number(s), 0.f, 1.f);
  } else if (s.name == "illum") {
    const float model = take_number(s);
    const bool known = model >= 0 && model <= 10 && model == std::floor(model);
    m.illum = known ? static_cast<int>(model) : 2;
    if (!known) tallies.bad_illum.add(line);
  } else if (const std::string keyword = fold_case(s.name); names_a_texture(keyword)) {
    read_texture(s, keyword, files, reading, tallies);
  }  // Ka and the rest are not used
}

/// A map without a colour to multiply shows its own colours. So does a diffuse map over black, which would show
/// nothing.
void mark_maps_alone(Reading& reading) {
  for (TextureMap& map : reading.material.maps) {
    if (map.kind == MapKind::diffuse) map.alone = !reading.opacity.has_kd || reading.material.kd == vec3(0);
    if (map.kind == MapKind::specular) map.alone = !reading.has_ks;
    if (map.kind == MapKind::emitted) map.alone = !reading.has_ke;
  }
}

KindWish wish_for(const std::string& name, const MaterialKinds& kinds) {
  const auto has = [&](const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return has(kinds.glass) ? KindWish::glass : has(kinds.opaque) ? KindWish::opaque : KindWish::none;
}

void finish_material(Reading& reading, const MaterialKinds& kinds, Tallies& tallies, std::vector<Material>& materials) {
  mark_maps_alone(reading);
  const std::string& name = reading.material.name;
  const vec3 color = glm::max(reading.material.kd, reading.material.ks);
  if (std::max({color.x, color.y, color.z}) > kLargestColor) tallies.large_colors.add(name);
  const OpacityNote note = settle_opacity(reading.material, reading.opacity, wish_for(name, kinds));
  if (note.illum_ignored)
    tallies.illum_ignored.add(name);
  else if (note.tr_ignored)
    tallies.tr_ignored.add(name);
  resolve_material(reading.material);
  materials.push_back(std::move(reading.material));
}

void report_tallies(const Tallies& tallies, const TextureFinds& files, const std::filesystem::path& path,
                    Warnings& warnings) {
  report(WarningCode::map_unread, tallies.unread_kinds, "texture maps (bump, disp and others) are not read yet", path,
         warnings);
  files.report(path, warnings);
  report(WarningCode::material_color_unread, tallies.foreign_colors,
         "colours are given as spectral or xyz, which are not read", path, warnings);
  report(WarningCode::material_value_unusable, tallies.bad_ni,
         "indices of refraction (Ni) are not above 0 and were set to 1", path, warnings);
  report(WarningCode::material_value_unusable, tallies.bad_illum,
         "illumination models (illum) are not 0 to 10 and were set to 2", path, warnings);
  const auto told = [&](WarningCode code, const NameList& names, const char* what, const char* to_do) {
    if (names.count() > 0)
      warnings.emplace_back(code, fmt::format("{}: {} materials {} ({}); {}", path.filename().string(), names.count(),
                                              what, names.text(), to_do));
  };
  told(WarningCode::material_color_large, tallies.large_colors, "have a Kd or Ks far above 1: colours of 0 to 255?",
       "divide them by 255");
  const char* const name_glass = "name those that are glass under \"glass\" in a scene JSON";
  told(WarningCode::material_drawn_opaque, tallies.illum_ignored,
       "say illum 4 or 9 but have a colour and no Tf below 1, and are drawn opaque", name_glass);
  told(WarningCode::material_drawn_opaque, tallies.tr_ignored, "say Tr 1 and no d, and are drawn opaque", name_glass);
}

}  // namespace

Material default_material() {
  Material material;
  material.name = "default";
  resolve_material(material);
  return material;
}

void read_mtl(const std::filesystem::path& path, std::vector<Material>& materials, Warnings& warnings,
              const MaterialKinds& kinds, const std::vector<std::filesystem::path>& more_folders) {
  TextLines lines(path, LineJoin::none);
  std::vector<std::filesystem::path> folders{path.parent_path()};
  folders.insert(folders.end(), more_folders.begin(), more_folders.end());
  TextureFinds files(std::move(folders));
  Tallies tallies;
  Reading reading;
  bool inside = false;  // statements before the first newmtl belong to no material
  for (std::string_view line; lines.next(line);) {
    Statement s{lines, {}, line};
    s.name = take_word(s.rest);
    if (s.name.empty() || s.name.starts_with('#')) continue;
    if (s.name == "newmtl") {
      if (inside) finish_material(reading, kinds, tallies, materials);
      inside = true;
      reading = {};
      reading.material.name = trimmed(s.rest);
    } else if (inside) {
      read_statement(s, files, reading, tallies);
    }
  }
  if (inside) finish_material(reading, kinds, tallies, materials);
  report_tallies(tallies, files, path, warnings);
}

}  // namespace hybridrt
