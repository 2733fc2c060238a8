#include "core/scene/obj_parse.h"

#include <istream>
#include <unordered_map>

#include "core/base/error.h"
#include "core/scene/obj_filter.h"
#include "core/scene/polygon.h"

// The only place that compiles tinyobjloader. Doubles: coordinates in the millions keep their millimetres.
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace hybridrt {
namespace {

constexpr double kLargestCoordinate = 1e30;  // its square still fits a double, itself a float

/// What the callbacks fill. We take indices raw and cut polygons ourselves: tinyobjloader's own ear
/// clipping depends on where the origin is, and is cubic in the corners.
struct Builder {
  explicit Builder(const ObjFilter& obj_filter) : filter(obj_filter) {}

  const ObjFilter& filter;
  MeshData data;
  std::unordered_map<std::string, uint32_t> material_ids;
  uint32_t material = 0;
  Tally tangled;

  struct Corner {
    uint32_t position, normal;
  };
  /// A polygon that names vertices which come later in the file; its triangles wait as placeholders.
  struct Waiting {
    size_t first_triangle;
    uint32_t line;
    std::vector<Corner> corners;
  };
  std::vector<Waiting> waiting;
  std::vector<Corner> corners;  // of the face at hand; kept for their memory, as are the next two
  std::vector<dvec3> points;
  std::vector<uvec3> cuts;
};

void add_vertex(void* user, double x, double y, double z, double) {
  auto& b = *static_cast<Builder*>(user);
  const dvec3 p(x, y, z);
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(p[axis]) < kLargestCoordinate))
      throw error(ErrorKind::input, "{}:{}: vertex {}: its {} coordinate is not below 1e30; scale the mesh",
                  b.filter.path().string(), b.filter.line(), b.data.positions.size() + 1, "xyz"[axis]);
  b.data.positions.push_back(p);
}

void add_normal(void* user, double x, double y, double z) {
  auto& b = *static_cast<Builder*>(user);
  b.data.normals.push_back(usable_normal(dvec3(x, y, z)));
}

void set_material(void* user, const char* rest_of_line, int) {
  auto& b = *static_cast<Builder*>(user);
  const std::string name(trimmed(rest_of_line));
  const auto [entry, is_new] =
      b.material_ids.try_emplace(name, static_cast<uint32_t>(b.data.material_names.size()));
  if (is_new) b.data.material_names.push_back(name);
  b.material = entry->second;
}

/// A 1-based or, from the end, negative index of the file; kNoIndex for 0.
uint32_t resolved(int index, size_t count) {
  if (index == 0) return kNoIndex;
  return index > 0 ? static_cast<uint32_t>(index - 1)
                   : static_cast<uint32_t>(static_cast<int64_t>(count) + index);
}

void append_triangle(Builder& b, const Builder::Corner& p, const Builder::Corner& q,
                     const Builder::Corner& r) {
  MeshData& data = b.data;
  const bool has_normal = p.normal != kNoIndex || q.normal != kNoIndex || r.normal != kNoIndex;
  if (has_normal && data.triangle_normals.empty())
    data.triangle_normals.resize(data.triangle_positions.size(), uvec3(kNoIndex));
  data.triangle_positions.emplace_back(p.position, q.position, r.position);
  if (has_normal || !data.triangle_normals.empty())
    data.triangle_normals.emplace_back(p.normal, q.normal, r.normal);
  data.triangle_materials.push_back(b.material);
  data.triangle_places.push_back(static_cast<uint32_t>(b.filter.line()));
}

/// Cuts `corners`, whose positions are all known, into b.cuts.
void cut_polygon(Builder& b, const std::vector<Builder::Corner>& corners, size_t line) {
  b.points.clear(), b.cuts.clear();
  for (const Builder::Corner& corner : corners) b.points.push_back(b.data.positions[corner.position]);
  if (!triangulate_polygon(b.points, b.cuts)) b.tangled.add(line);
}

void add_face(void* user, tinyobj::index_t* indices, int count) {
  auto& b = *static_cast<Builder*>(user);
  if (count < 3) return;  // counted by the filter
  b.corners.clear();
  uint32_t farthest = 0;
  for (int i = 0; i < count; ++i) {
    b.corners.push_back({resolved(indices[i].vertex_index, b.data.positions.size()),
                         resolved(indices[i].normal_index, b.data.normals.size())});
    farthest = std::max(farthest, b.corners.back().position);
  }
  if (count == 3) return append_triangle(b, b.corners[0], b.corners[1], b.corners[2]);
  if (farthest >= b.data.positions.size()) {
    b.waiting.push_back(
        {b.data.triangle_positions.size(), static_cast<uint32_t>(b.filter.line()), b.corners});
    // One with a normal, so that the placeholders have room for normals.
    for (int i = 2; i < count; ++i) append_triangle(b, b.corners[0], b.corners[i - 1], b.corners[i]);
    return;
  }
  cut_polygon(b, b.corners, b.filter.line());
  for (const uvec3& cut : b.cuts) append_triangle(b, b.corners[cut[0]], b.corners[cut[1]], b.corners[cut[2]]);
}

void cut_waiting_polygons(Builder& b) {
  for (const Builder::Waiting& polygon : b.waiting) {
    cut_polygon(b, polygon.corners, polygon.line);
    for (size_t i = 0; i < b.cuts.size(); ++i)
      for (int corner = 0; corner < 3; ++corner) {
        const Builder::Corner& from = polygon.corners[b.cuts[i][corner]];
        b.data.triangle_positions[polygon.first_triangle + i][corner] = from.position;
        if (!b.data.triangle_normals.empty())
          b.data.triangle_normals[polygon.first_triangle + i][corner] = from.normal;
      }
  }
}

}  // namespace

MeshData parse_obj(const std::filesystem::path& path, Warnings& warnings) {
  ObjFilter filter(path);
  std::istream stream(&filter);
  stream.exceptions(std::ios::badbit);  // so that an Error thrown by the filter reaches our caller

  Builder builder(filter);
  builder.data.path = path;
  builder.material_ids.emplace("", 0);
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = add_vertex;
  callbacks.normal_cb = add_normal;
  callbacks.index_cb = add_face;
  callbacks.usemtl_cb = set_material;
  tinyobj::LoadObjWithCallback(stream, callbacks, &builder);

  filter.finish(warnings);
  cut_waiting_polygons(builder);
  report(builder.tangled, "polygons cross themselves or have no area and were cut as they came", path,
         warnings);
  builder.data.libraries = filter.libraries();
  builder.data.faces = filter.faces();
  return std::move(builder.data);
}

}  // namespace hybridrt
