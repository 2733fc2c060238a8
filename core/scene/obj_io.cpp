#include "core/scene/obj_io.h"

#include <algorithm>
#include <unordered_map>

#include "core/base/error.h"
#include "core/scene/mtl_io.h"
#include "core/scene/normals.h"
#include "core/scene/obj_parse.h"
#include "core/scene/text_scan.h"

namespace hybridrt {
namespace {

constexpr size_t kGrain = 1 << 16;
constexpr double kFarFromOrigin = 16;  // times the scene's size
constexpr double kLargestScene =
    1e18;  // beyond, squares of lengths leave the range of float; and below 1 / this

/// Of the vertices that triangles use, in double.
struct WorldBox {
  dvec3 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};
};

WorldBox world_box(const ObjData& obj) {
  WorldBox box;
  for (const uvec3& triangle : obj.triangle_positions)
    for (int corner = 0; corner < 3; ++corner) {
      const dvec3& p = obj.positions[triangle[corner]];
      box.lo = glm::min(box.lo, p), box.hi = glm::max(box.hi, p);
    }
  return box;
}

double largest(const dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// The box centre on a grid as coarse as the box is large: few bits, so that p - origin is exact in double
/// and the same whatever else is in the file's neighbourhood.
dvec3 choose_origin(const WorldBox& box) {
  const double size = largest(box.hi - box.lo);
  const double reach = largest(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
  if (reach <= kFarFromOrigin * size) return dvec3(0);
  const double grid = std::exp2(std::floor(std::log2(size)));
  return glm::round((box.lo + (box.hi - box.lo) / 2.0) / grid) * grid;
}

enum class Fault : uint8_t { none, repeated_vertex, no_area };

Fault fault_of(const std::vector<vec3>& positions, const uvec3& t) {
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

void leave_out_degenerate(ObjData& obj, const std::vector<vec3>& positions, ThreadPool& pool,
                          const std::filesystem::path& path, Warnings& warnings) {
  std::vector<Fault> faults(obj.triangle_positions.size());
  parallel_for(pool, faults.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) faults[i] = fault_of(positions, obj.triangle_positions[i]);
  });
  Tally repeated, flat;
  for (size_t i = 0; i < faults.size(); ++i) {
    if (faults[i] == Fault::repeated_vertex) repeated.add(obj.triangle_lines[i]);
    if (faults[i] == Fault::no_area) flat.add(obj.triangle_lines[i]);
  }
  report(repeated, "triangles that repeat a vertex were left out", path, warnings);
  report(flat, "triangles of zero area were left out", path, warnings);
  if (repeated.count + flat.count == 0) return;
  keep_good(obj.triangle_positions, faults);
  keep_good(obj.triangle_normals, faults);
  keep_good(obj.triangle_materials, faults);
  keep_good(obj.triangle_lines, faults);
}

/// Moves the file's normals into the scene; corners whose normal is missing or unusable become kNoNormal.
void take_normals(ObjData& obj, Scene& scene, const std::filesystem::path& path, Warnings& warnings) {
  static_assert(kNoNormal == kNoIndex);
  scene.triangle_normals = std::move(obj.triangle_normals);
  scene.triangle_normals.resize(scene.triangle_positions.size(), uvec3(kNoNormal));
  scene.normals = std::move(obj.normals);
  Tally bad;
  for (size_t i = 0; i < scene.triangle_normals.size(); ++i)
    for (int corner = 0; corner < 3; ++corner) {
      uint32_t& normal = scene.triangle_normals[i][corner];
      if (normal >= scene.normals.size()) {
        normal = kNoNormal;
      } else if (scene.normals[normal] == vec3(0)) {
        normal = kNoNormal;
        bad.add(obj.triangle_lines[i]);
      }
    }
  for (vec3& normal : scene.normals)
    if (normal == vec3(0)) normal = vec3(0, 1, 0);  // no corner uses it any more; keeps the others' places
  report(bad, "corners had a zero or unreadable normal, rebuilt from the faces around", path, warnings);
}

/// Turns the file's usemtl numbers into indices of scene.materials.
void take_materials(ObjData& obj, std::vector<Material> library, Scene& scene,
                    const std::filesystem::path& path, Warnings& warnings) {
  std::unordered_map<std::string_view, uint32_t> by_name;
  for (const Material& material : library)
    by_name.emplace(material.name, static_cast<uint32_t>(by_name.size()));
  std::vector<uint32_t> library_index(obj.material_names.size(), kNoIndex);
  for (size_t i = 1; i < obj.material_names.size(); ++i)
    if (const auto known = by_name.find(obj.material_names[i]); known != by_name.end())
      library_index[i] = known->second;

  bool default_used = false;
  Tally unknown;
  uint32_t first_unknown = 0;
  for (size_t i = 0; i < obj.triangle_materials.size(); ++i) {
    const uint32_t name = obj.triangle_materials[i];
    if (library_index[name] != kNoIndex) continue;
    default_used = true;
    if (name == 0) continue;
    if (unknown.count == 0) first_unknown = name;
    unknown.add(obj.triangle_lines[i]);
  }
  if (unknown.count > 0) {
    const std::string what =
        fmt::format("triangles use materials that no MTL file defines ({}) and are drawn as default",
                    in_quotes(obj.material_names[first_unknown]));
    report(unknown, what, path, warnings);
  }
  if (default_used) scene.materials.push_back(default_material());
  const auto shift = static_cast<uint32_t>(scene.materials.size());
  for (Material& material : library) scene.materials.push_back(std::move(material));
  for (uint32_t& material : obj.triangle_materials)
    material = library_index[material] == kNoIndex ? 0 : library_index[material] + shift;
  scene.triangle_materials = std::move(obj.triangle_materials);
}

}  // namespace

Scene load_obj(const std::filesystem::path& path, ThreadPool& pool, Warnings& warnings) {
  ObjData obj = parse_obj(path, warnings);
  if (obj.faces == 0)
    throw error(ErrorKind::input, "{} has no faces ({} vertices): nothing to draw; is it an OBJ file?",
                path.string(), obj.positions.size());
  if (obj.triangle_positions.empty())
    throw error(ErrorKind::input, "{}: none of its {} faces has three corners: nothing to draw",
                path.string(), obj.faces);

  const WorldBox box = world_box(obj);
  const double size = largest(box.hi - box.lo);
  if (size > kLargestScene || (size > 0 && size < 1 / kLargestScene))
    throw error(ErrorKind::input, "{} is {:g} units across, which single precision cannot render; scale it",
                path.string(), size);
  Scene scene;
  scene.files.push_back(path.string());
  scene.origin_world = choose_origin(box);
  scene.positions.resize(obj.positions.size());
  parallel_for(pool, obj.positions.size(), kGrain, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) scene.positions[i] = vec3(obj.positions[i] - scene.origin_world);
  });
  obj.positions = {};

  leave_out_degenerate(obj, scene.positions, pool, path, warnings);
  if (obj.triangle_positions.empty())
    throw error(ErrorKind::input, "{}: all of its faces have zero area: nothing to draw", path.string());
  scene.triangle_positions = std::move(obj.triangle_positions);
  take_normals(obj, scene, path, warnings);
  std::vector<Material> library = read_libraries(path.parent_path(), obj.libraries, scene.files, warnings);
  take_materials(obj, std::move(library), scene, path, warnings);
  obj = {};

  rebuild_missing_normals(scene, pool);
  scene.bounds = compute_bounds(scene);
  validate(scene);
  return scene;
}

}  // namespace hybridrt
