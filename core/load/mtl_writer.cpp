#include "core/load/mtl_writer.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <system_error>

#include "core/load/mtl_io.h"
#include "core/load/written_line.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMapKeywords[] = {"map_Kd", "map_Ks", "map_Ke", "map_d"};  // by MapKind

/// Whether the colour must not be given, so that its map is read as standing alone.
bool map_is_alone(const Material& m, MapKind kind) {
  return std::any_of(m.maps.begin(), m.maps.end(),
                     [&](const TextureMap& map) { return map.kind == kind && map.alone; });
}

fs::path seen_from(const fs::path& folder, const fs::path& file) {
  std::error_code failed;
  const fs::path relative = fs::relative(file, folder.empty() ? fs::path(".") : folder, failed);
  return failed || relative.empty() ? fs::absolute(file, failed) : relative;
}

void write_map(const TextureMap& map, const fs::path& folder, WrittenLine& line) {
  const TextureMap plain;
  line.text(kMapKeywords[static_cast<int>(map.kind)]);
  if (map.scale != plain.scale) line.text(" -s").vector(map.scale).text(" 1");
  if (map.offset != plain.offset) line.text(" -o").vector(map.offset).text(" 0");
  if (map.base != plain.base || map.gain != plain.gain) line.text(" -mm").vector(vec2(map.base, map.gain));
  if (map.clamped) line.text(" -clamp on");
  if (map.channel != 0) line.text(" -imfchan ").text(std::string_view(&map.channel, 1));
  line.text(" ").text(seen_from(folder, map.path).string()).end();
}

bool same_map(const TextureMap& a, const TextureMap& b) {
  std::error_code missing;
  return a.kind == b.kind && a.scale == b.scale && a.offset == b.offset && a.clamped == b.clamped && a.base == b.base &&
         a.gain == b.gain && a.alone == b.alone && a.channel == b.channel && fs::equivalent(a.path, b.path, missing);
}

/// Whether both look alike: what resolve_material() has dropped does not count.
bool same_material(const Material& a, const Material& b) {
  const bool colors = (a.kd == b.kd || map_is_alone(a, MapKind::diffuse)) && a.ks == b.ks && a.ke == b.ke;
  const bool rays = a.reflect == b.reflect && a.transmit == b.transmit && a.fresnel == b.fresnel && a.ni == b.ni;
  return colors && rays && a.ns == b.ns && a.opacity == b.opacity &&
         std::is_permutation(a.maps.begin(), a.maps.end(), b.maps.begin(), b.maps.end(), same_map);
}

}  // namespace

std::vector<std::string> distinct_names(std::span<const Material> materials) {
  std::set<std::string> taken;
  for (const Material& material : materials) taken.insert(material.name);
  std::set<std::string> given;
  std::vector<std::string> names;
  for (const Material& material : materials) {
    const std::string base = material.name.empty() ? "unnamed" : material.name;
    std::string name = base;
    for (int number = 2; given.contains(name) || (name != material.name && taken.contains(name)); ++number)
      name = fmt::format("{}_{}", base, number);
    given.insert(name);
    names.push_back(std::move(name));
  }
  return names;
}

void write_mtl(std::span<const Material> materials, std::span<const std::string> names, const fs::path& folder,
               OutputFile& file) {
  WrittenLine line(file);
  for (size_t i = 0; i < materials.size(); ++i) {
    const Material& m = materials[i];
    line.text("newmtl ").text(names[i]).end();
    if (!map_is_alone(m, MapKind::diffuse)) line.text("Kd").vector(m.kd).end();
    if (!map_is_alone(m, MapKind::specular)) line.text("Ks").vector(m.ks).end();
    if (!map_is_alone(m, MapKind::emitted)) line.text("Ke").vector(m.ke).end();
    line.text("Ns ").number(m.ns).end();
    line.text("Ni ").number(m.ni).end();
    line.text("d ").number(m.opacity).end();
    line.text("Tf").vector(m.tf).end();
    line.text("illum ").number(m.illum == 4 || m.illum == 9 ? 6 : m.illum).end();
    for (const TextureMap& map : m.maps)
      if (!map.path.empty()) write_map(map, folder, line);
  }
}

void warn_of_lost_materials(std::span<const Material> materials, const fs::path& path, Warnings& warnings) {
  std::vector<Material> read;
  Warnings of_reading;  // of what was written on purpose
  read_mtl(path, read, of_reading);
  NameList lost;
  for (size_t i = 0; i < materials.size(); ++i)
    if (i >= read.size() || !same_material(materials[i], read[i])) lost.add(materials[i].name);
  if (lost.count() > 0)
    warnings.emplace_back(WarningCode::material_changed,
                          fmt::format("{}: {} materials are not quite what they were ({}): MTL cannot say it",
                                      path.filename().string(), lost.count(), lost.text()));
}

}  // namespace hybridrt
