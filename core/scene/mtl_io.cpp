#include "core/scene/mtl_io.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/text_lines.h"
#include "core/scene/text_scan.h"
#include "core/scene/texture_name.h"

namespace hybridrt {
namespace {

/// Where a statement stands, and what is left of it.
struct Statement {
  const TextLines& lines;
  std::string_view name, rest;
};

float take_number(Statement& s) {
  const std::string_view word = take_word(s.rest);
  const std::optional<double> number = parse_number(word);
  const std::string where = fmt::format("{}:{}: {}", s.lines.path().string(), s.lines.line_number(), s.name);
  if (word.empty()) throw error(ErrorKind::input, "{} has no number behind it; mend or remove that line", where);
  if (!number || std::abs(*number) > 1e30)
    throw error(ErrorKind::input, "{}: {} is not a usable number; mend or remove that line", where, in_quotes(word));
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

bool names_a_texture(std::string_view statement) {
  return statement.starts_with("map_") || statement == "bump" || statement == "disp" ||
         statement == "decal" || statement == "refl" || statement == "norm";
}

struct Tallies {
  Tally textures, foreign_textures, missing_textures, foreign_colors, bad_ni, bad_illum;
  std::string first_missing;
};

/// Counts the texture and what is wrong with its name.
void look_for_texture(const Statement& s, Tallies& tallies) {
  const size_t line = s.lines.line_number();
  tallies.textures.add(line);
  const std::string name = texture_name(s.rest);
  const TextureFile file = find_texture(s.lines.path().parent_path(), name);
  if (file.foreign) tallies.foreign_textures.add(line);
  if (!file.path.empty()) return;
  if (tallies.missing_textures.count == 0) tallies.first_missing = name;
  tallies.missing_textures.add(line);
}

struct Reading {
  Material material;
  float dissolve = -1, transparency = -1;  ///< d and Tr as given; -1: not given
};

void read_statement(Statement& s, Reading& reading, Tallies& tallies) {
  Material& m = reading.material;
  const size_t line = s.lines.line_number();
  const auto color = [&](vec3& to) {
    if (!take_color(s, to)) tallies.foreign_colors.add(line);
  };
  if (s.name == "Kd") return color(m.kd);
  if (s.name == "Ks") return color(m.ks);
  if (s.name == "Ke") return color(m.ke);
  if (s.name == "Tf") return color(m.tf);
  if (s.name == "Ns") {
    m.ns = std::clamp(take_number(s), 0.f, 1e4f);
  } else if (s.name == "Ni") {
    m.ni = take_number(s);
    if (m.ni <= 0) m.ni = 1, tallies.bad_ni.add(line);
  } else if (s.name == "d") {
    std::string_view peek = s.rest;
    if (take_word(peek) == "-halo") s.rest = peek;  // fades with the angle; we take the plain factor
    reading.dissolve = std::clamp(take_number(s), 0.f, 1.f);
  } else if (s.name == "Tr") {
    reading.transparency = std::clamp(take_number(s), 0.f, 1.f);
  } else if (s.name == "illum") {
    const float model = take_number(s);
    const bool known = model >= 0 && model <= 10 && model == std::floor(model);
    m.illum = known ? static_cast<int>(model) : 2;
    if (!known) tallies.bad_illum.add(line);
  } else if (names_a_texture(s.name)) {
    look_for_texture(s, tallies);
  }  // Ka and what else there is: not used
}

void finish_material(Reading& reading, std::vector<Material>& materials) {
  if (reading.dissolve >= 0)
    reading.material.opacity = reading.dissolve;
  else if (reading.transparency >= 0)
    reading.material.opacity = 1 - reading.transparency;
  resolve_material(reading.material);
  materials.push_back(std::move(reading.material));
}

}  // namespace

Material default_material() {
  Material material;
  material.name = "default";
  resolve_material(material);
  return material;
}

void read_mtl(const std::filesystem::path& path, std::vector<Material>& materials, Warnings& warnings) {
  TextLines lines(path, LineJoin::none);
  Tallies tallies;
  Reading reading;
  bool inside = false;  // what stands before the first newmtl belongs to nothing
  for (std::string_view line; lines.next(line);) {
    Statement s{lines, {}, line};
    s.name = take_word(s.rest);
    if (s.name.empty() || s.name.starts_with('#')) continue;
    if (s.name == "newmtl") {
      if (inside) finish_material(reading, materials);
      inside = true;
      reading = {};
      reading.material.name = trimmed(s.rest);
    } else if (inside) {
      read_statement(s, reading, tallies);
    }
  }
  if (inside) finish_material(reading, materials);

  report(tallies.textures, "texture maps are not read yet", path, warnings);
  report(tallies.foreign_textures, "texture names lead to other folders; only files beside the MTL are looked for", path,
         warnings);
  report(tallies.missing_textures, fmt::format("texture files are missing ({})", in_quotes(tallies.first_missing)), path,
         warnings);
  report(tallies.foreign_colors, "colours are given as spectral or xyz, which are not read", path, warnings);
  report(tallies.bad_ni, "indices of refraction (Ni) are not above 0 and were set to 1", path, warnings);
  report(tallies.bad_illum, "illumination models (illum) are not 0 to 10 and were set to 2", path, warnings);
}

}  // namespace hybridrt
