#include "core/load/assemble_scene.h"

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/invisible.h"
#include "core/load/load_textures.h"
#include "core/load/mesh_colors.h"
#include "core/load/mtl_io.h"
#include "core/load/text_scan.h"
#include "core/mesh/normals.h"
#include "core/scene/scene_origin.h"

namespace hybridrt {
namespace {

constexpr size_t kGrain = 1 << 16;
constexpr double kLargestScene = 1e18;  // beyond, squares of lengths leave the range of float; and below 1 / this

/// The vertices that triangles use.
void grow(WorldBox& box, const MeshData& mesh) {
  for (const uvec3& triangle : mesh.triangle_positions)
    for (int corner = 0; corner < 3; ++corner) box.grow(mesh.positions[triangle[corner]]);
}

enum class Fault : uint8_t { none, repeated_vertex, no_area };

Fault fault_of(std::span<const vec3> positions, const uvec3& t) {
  if (t.x == t.y || t.y == t.z || t.z == t.x) return Fault::repeated_vertex;
  const dvec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
  const dvec3 cross = glm::cross(b - a, c - a);  // differences of floats: exact, or nearly
  return cross == dvec3(0) ? Fault::no_area : Fault::none;
}

template <typename T>
void keep_good(std::vector<T>& elements, const std::vector<Fault>& faults) {
  if (elements.empty()) return;
  size_t kept = 0;
  for (size_t i = 0; i < elements.size(); ++i)
    if (faults[i] == Fault::none) elements[kept++] = elements[i];
  elements.resize(kept);
}

void leave_out_degenerate(MeshData& mesh, std::span<const vec3> positions, ThreadPool& pool, Warnings& warnings) {
  std::vector<Fault> faults(mesh.triangle_positions.size());
  parallel_for(pool, faults.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) faults[i] = fault_of(positions, mesh.triangle_positions[i]);
  });
  Tally repeated, flat;
  for (size_t i = 0; i < faults.size(); ++i) {
    if (faults[i] == Fault::repeated_vertex) repeated.add(mesh.triangle_places[i]);
    if (faults[i] == Fault::no_area) flat.add(mesh.triangle_places[i]);
  }
  report(WarningCode::triangle_degenerate, repeated, "triangles that repeat a vertex were left out", mesh.path,
         warnings, mesh.place);
  report(WarningCode::triangle_degenerate, flat, "triangles of zero area were left out", mesh.path, warnings,
         mesh.place);
  if (repeated.count + flat.count == 0) return;
  keep_good(mesh.triangle_positions, faults);
  keep_good(mesh.triangle_normals, faults);
  keep_good(mesh.triangle_texcoords, faults);
  keep_good(mesh.triangle_colors, faults);
  keep_good(mesh.triangle_materials, faults);
  keep_good(mesh.triangle_places, faults);
}

/// Appends `values` to `all`; reuses the memory of `values` if `all` is empty.
template <typename T>
void append(std::vector<T>& all, std::vector<T>&& values) {
  if (all.empty())
    all = std::move(values);
  else
    all.insert(all.end(), values.begin(), values.end());
}

/// Appends positions and triangles of a mesh whose positions have become scene.positions[first..].
void take_triangles(MeshData& mesh, uint32_t first, Scene& scene) {
  if (first > 0)
    for (uvec3& triangle : mesh.triangle_positions) triangle += first;
  append(scene.triangle_positions, std::move(mesh.triangle_positions));
}

/// Appends the file's normals; corners whose normal is missing or unusable become kNoNormal.
void take_normals(MeshData& mesh, Scene& scene, Warnings& warnings) {
  static_assert(kNoNormal == kNoIndex);
  const size_t count = mesh.normals.size();
  const auto first = static_cast<uint32_t>(scene.normals.size());
  mesh.triangle_normals.resize(mesh.triangle_materials.size(), uvec3(kNoNormal));
  Tally bad;
  for (size_t i = 0; i < mesh.triangle_normals.size(); ++i)
    for (int corner = 0; corner < 3; ++corner) {
      uint32_t& normal = mesh.triangle_normals[i][corner];
      if (normal >= count) {
        normal = kNoNormal;
      } else if (mesh.normals[normal] == vec3(0)) {
        normal = kNoNormal;
        bad.add(mesh.triangle_places[i]);
      } else {
        normal += first;
      }
    }
  for (vec3& normal : mesh.normals)
    if (normal == vec3(0)) normal = vec3(0, 1, 0);  // no corner uses it any more; keeps the others' indices
  report(WarningCode::normal_unusable, bad, "corners had a zero or unreadable normal, rebuilt from the faces around",
         mesh.path, warnings, mesh.place);
  append(scene.normals, std::move(mesh.normals));
  append(scene.triangle_normals, std::move(mesh.triangle_normals));
}

/// Whether any of the meshes may need a texture.
bool needs_texcoords(const std::vector<LoadedMesh>& meshes, const LoadWatch& watch) {
  const auto has_maps = [](const Material& material) { return !material.maps.empty(); };
  return watch.textures && std::any_of(meshes.begin(), meshes.end(), [&](const LoadedMesh& mesh) {
           return std::any_of(mesh.library.begin(), mesh.library.end(), has_maps);
         });
}

/// Appends the file's texture coordinates; corners that have none get kNoIndex.
void take_texcoords(MeshData& mesh, Textures& textures) {
  const auto first = static_cast<uint32_t>(textures.texcoords.size());
  mesh.triangle_texcoords.resize(mesh.triangle_materials.size(), uvec3(kNoIndex));
  for (uvec3& corners : mesh.triangle_texcoords)
    for (int corner = 0; corner < 3; ++corner)
      corners[corner] = corners[corner] < mesh.texcoords.size() ? corners[corner] + first : kNoIndex;
  append(textures.texcoords, std::move(mesh.texcoords));
  append(textures.triangle_texcoords, std::move(mesh.triangle_texcoords));
}

constexpr uint32_t kDefaultMaterial = 0;  // until it is known whether any triangle uses it

/// Turns the file's material numbers into 1 + the index in scene.materials, or kDefaultMaterial for none.
void take_materials(LoadedMesh& loaded, Scene& scene, Warnings& warnings) {
  MeshData& mesh = loaded.data;
  const auto first = static_cast<uint32_t>(scene.materials.size()) + 1;
  std::unordered_map<std::string_view, uint32_t> by_name;
  for (const Material& material : loaded.library)
    by_name.emplace(material.name, first + static_cast<uint32_t>(by_name.size()));
  std::vector<uint32_t> meaning(mesh.material_names.size(), kDefaultMaterial);
  for (size_t i = 1; i < mesh.material_names.size(); ++i)
    if (const auto known = by_name.find(mesh.material_names[i]); known != by_name.end()) meaning[i] = known->second;

  if (mesh.material_names.size() == 1 && !loaded.library.empty()) {
    const bool only = loaded.library.size() == 1;
    if (only) meaning[0] = first;
    warnings.emplace_back(
        WarningCode::material_unnamed,
        fmt::format("{}: no usemtl, so {}", mesh.path.filename().string(),
                    only ? fmt::format("the one material of its MTL, {}, is used for all of it",
                                       in_quotes(loaded.library[0].name))
                         : fmt::format("none of the {} materials of its MTL is used; drawn as default",
                                       loaded.library.size())));
  }

  Tally unknown;
  uint32_t first_unknown = 0;
  for (size_t i = 0; i < mesh.triangle_materials.size(); ++i) {
    const uint32_t name = std::exchange(mesh.triangle_materials[i], meaning[mesh.triangle_materials[i]]);
    if (name == 0 || meaning[name] != kDefaultMaterial) continue;
    if (unknown.count == 0) first_unknown = name;
    unknown.add(mesh.triangle_places[i]);
  }
  if (unknown.count > 0)
    report(WarningCode::material_unknown, unknown,
           fmt::format("triangles use materials that no MTL file defines ({}) and are drawn as default",
                       in_quotes(mesh.material_names[first_unknown])),
           mesh.path, warnings, mesh.place);
  by_name.clear();  // it points into the library
  for (Material& material : loaded.library) scene.materials.push_back(std::move(material));
  append(scene.triangle_materials, std::move(mesh.triangle_materials));
}

/// Puts the default material first if it is used; else drops it and renumbers the others.
void place_default_material(Scene& scene) {
  auto& indices = scene.triangle_materials;
  if (std::find(indices.begin(), indices.end(), kDefaultMaterial) != indices.end())
    scene.materials.insert(scene.materials.begin(), default_material());
  else
    for (uint32_t& material : indices) --material;
}

void require_faces(const MeshData& mesh) {
  if (mesh.faces == 0)
    throw error(ErrorKind::input, "{} has no faces ({} vertices): nothing to draw; is it a mesh file?",
                mesh.path.string(), mesh.positions.size());
  if (mesh.triangle_positions.empty())
    throw error(ErrorKind::input, "{}: none of its {} faces has three corners: nothing to draw; are they lines?",
                mesh.path.string(), mesh.faces);
}

}  // namespace

vec3 usable_normal(const dvec3& n) {
  const vec3 unit(n);
  const double square = glm::dot(dvec3(unit), dvec3(unit));
  if (std::abs(square - 1) < 1e-6) return unit;
  const double length = glm::length(n);
  return length > 1e-30 && std::isfinite(length) ? vec3(n / length) : vec3(0);
}

Scene assemble_scene(std::vector<LoadedMesh> meshes, ThreadPool& pool, Warnings& warnings, const LoadWatch& watch) {
  HRT_CHECK(!meshes.empty());
  WorldBox box;
  size_t positions = 0;
  for (const LoadedMesh& mesh : meshes) {
    require_faces(mesh.data);
    grow(box, mesh.data);
    positions += mesh.data.positions.size();
  }
  const std::string all = meshes.front().data.path.string() + (meshes.size() > 1 ? " and the other meshes" : "");
  if (positions >= size_t{1} << 31)
    throw error(ErrorKind::input, "{}: {} vertices are more than the 2147483647 that can be counted", all, positions);
  const double size = box.size();
  if (size > kLargestScene || (size > 0 && size < 1 / kLargestScene))
    throw error(ErrorKind::input, "{}: {:g} units across, which single precision cannot render; scale it", all, size);

  Scene scene;
  for (const LoadedMesh& mesh : meshes) {
    scene.files.push_back(mesh.data.path.string());
    scene.files.insert(scene.files.end(), mesh.library_files.begin(), mesh.library_files.end());
  }
  scene.origin_world = choose_scene_origin(box);
  scene.positions.reserve(positions + 1);  // Embree can borrow positions that are not the end of their memory
  scene.positions.resize(positions);
  Textures textures;
  const bool keep_texcoords = needs_texcoords(meshes, watch);
  uint32_t first = 0, colored_material = 0;
  for (LoadedMesh& loaded : meshes) {
    MeshData& mesh = loaded.data;
    const std::span<vec3> own = std::span(scene.positions).subspan(first, mesh.positions.size());
    parallel_for(pool, own.size(), kGrain, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) own[i] = vec3(mesh.positions[i] - scene.origin_world);
    });
    mesh.positions = {};
    leave_out_degenerate(mesh, own, pool, warnings);
    if (mesh.triangle_positions.empty())
      throw error(ErrorKind::input, "{}: all of its faces have zero area: nothing to draw; is it flattened?",
                  mesh.path.string());
    const size_t first_triangle = scene.triangle_count();
    take_triangles(mesh, first, scene);
    take_normals(mesh, scene, warnings);
    if (keep_texcoords) take_texcoords(mesh, textures);
    take_materials(loaded, scene, warnings);
    take_colors(mesh, first_triangle, first, watch.linear_colors, scene, colored_material, warnings);
    first += static_cast<uint32_t>(own.size());
    loaded = {};
  }
  if (scene.has_colors()) scene.triangle_colors.resize(scene.triangle_count(), uvec3(0));  // white
  place_default_material(scene);
  if (keep_texcoords) load_textures(scene, std::move(textures), pool, warnings, watch);
  report_invisible(scene, warnings);
  rebuild_missing_normals(scene, pool);
  scene.bounds = compute_bounds(scene);
  validate(scene);
  return scene;
}

}  // namespace hybridrt
