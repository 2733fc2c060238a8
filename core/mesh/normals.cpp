#include "core/mesh/normals.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/mesh/weld.h"

namespace hybridrt {
namespace {

constexpr size_t kMostFaces = 256;
constexpr size_t kGrain = 1 << 13;        // vertices
constexpr uint32_t kLocal = 0x80000000u;  // marks an index into a chunk's own normals; kNoNormal has it too
const double kCosCrease = std::sqrt(0.5);

/// The corners (3 * triangle + corner) at each welded vertex, in the order of the triangles: corners[starts[v] ..
/// starts[v + 1]).
struct CornersOfVertices {
  std::vector<uint32_t> starts, corners;
};

CornersOfVertices corners_of_vertices(const Scene& scene, ThreadPool& pool) {
  const std::vector<uint32_t> welded = weld_positions(scene.positions, pool);
  CornersOfVertices result;
  result.starts.assign(scene.positions.size() + 1, 0);
  for (const uvec3& triangle : scene.triangle_positions)
    for (int k = 0; k < 3; ++k) ++result.starts[welded[triangle[k]] + 1];
  for (size_t v = 1; v < result.starts.size(); ++v) result.starts[v] += result.starts[v - 1];
  result.corners.resize(result.starts.back());
  std::vector<uint32_t> next(result.starts.begin(), result.starts.end() - 1);
  for (size_t t = 0; t < scene.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      result.corners[next[welded[scene.triangle_positions[t][k]]]++] = static_cast<uint32_t>(3 * t + k);
  return result;
}

struct FaceAtVertex {
  dvec3 normal;      ///< unit
  double angle_rad;  ///< the face's angle at the vertex
};

FaceAtVertex face_at_vertex(const Scene& scene, uint32_t corner) {
  const uint32_t t = corner / 3;
  const int k = corner % 3;
  const dvec3 p(scene.vertex(t, k));
  const dvec3 a = dvec3(scene.vertex(t, (k + 1) % 3)) - p;
  const dvec3 b = dvec3(scene.vertex(t, (k + 2) % 3)) - p;
  const dvec3 cross = glm::cross(a, b);
  const double length = glm::length(cross);
  if (length > 0) return {cross / length, std::atan2(length, glm::dot(a, b))};
  // A needle seen from its far end: rounding of two edges swallows the third. The loader's test for area starts from
  // the first corner.
  const dvec3 first(scene.vertex(t, 0));
  return {glm::normalize(glm::cross(dvec3(scene.vertex(t, 1)) - first, dvec3(scene.vertex(t, 2)) - first)), 0};
}

/// Writes the missing normals of one vertex, as local indices into `normals`.
void build_at_vertex(Scene& scene, std::span<const uint32_t> corners, std::vector<FaceAtVertex>& faces,
                     std::vector<vec3>& normals) {
  const auto slot = [&](uint32_t corner) -> uint32_t& { return scene.triangle_normals[corner / 3][corner % 3]; };
  if (std::none_of(corners.begin(), corners.end(), [&](uint32_t c) { return slot(c) == kNoNormal; })) return;

  faces.clear();
  for (uint32_t corner : corners) faces.push_back(face_at_vertex(scene, corner));
  const size_t first_own = normals.size();
  for (size_t i = 0; i < corners.size(); ++i) {
    if (slot(corners[i]) != kNoNormal) continue;
    dvec3 sum(0);
    if (faces.size() <= kMostFaces) {
      for (const FaceAtVertex& face : faces)
        if (glm::dot(face.normal, faces[i].normal) >= kCosCrease) sum += face.angle_rad * face.normal;
    } else {
      sum = faces[i].normal;
    }
    // Corners that average the same faces do so in the same order, and get the same bits. In large fans only the latest
    // normals are compared, which keeps the time linear.
    const vec3 normal(sum != dvec3(0) ? glm::normalize(sum) : faces[i].normal);
    const size_t from = std::max(first_own, normals.size() > kMostFaces ? normals.size() - kMostFaces : 0);
    const auto same = std::find(normals.begin() + from, normals.end(), normal);
    slot(corners[i]) = kLocal | static_cast<uint32_t>(same - normals.begin());
    if (same == normals.end()) normals.push_back(normal);
  }
}

}  // namespace

void rebuild_missing_normals(Scene& scene, ThreadPool& pool) {
  scene.built_normal_corners = 0;
  for (const uvec3& n : scene.triangle_normals)
    scene.built_normal_corners += (n.x == kNoNormal) + (n.y == kNoNormal) + (n.z == kNoNormal);
  if (scene.built_normal_corners == 0) return;
  HRT_CHECK(scene.triangle_count() < kLocal / 3 && scene.normals.size() < kLocal);

  const CornersOfVertices around = corners_of_vertices(scene, pool);
  const size_t vertices = scene.positions.size(), chunks = (vertices + kGrain - 1) / kGrain;
  std::vector<std::vector<vec3>> chunk_normals(chunks);
  parallel_for(pool, vertices, kGrain, [&](size_t begin, size_t end) {
    std::vector<FaceAtVertex> faces;
    for (size_t v = begin; v < end; ++v)
      build_at_vertex(scene,
                      std::span(around.corners).subspan(around.starts[v], around.starts[v + 1] - around.starts[v]),
                      faces, chunk_normals[begin / kGrain]);
  });

  // Joins the chunks' normals, in the order of the vertices.
  std::vector<size_t> base(chunks);
  size_t total = scene.normals.size();
  for (size_t chunk = 0; chunk < chunks; ++chunk) base[chunk] = total, total += chunk_normals[chunk].size();
  HRT_CHECK(total < kLocal);
  scene.normals.resize(total);
  parallel_for(pool, vertices, kGrain, [&](size_t begin, size_t end) {
    const size_t chunk = begin / kGrain;
    std::copy(chunk_normals[chunk].begin(), chunk_normals[chunk].end(), scene.normals.begin() + base[chunk]);
    for (uint32_t i = around.starts[begin]; i < around.starts[end]; ++i) {
      uint32_t& normal = scene.triangle_normals[around.corners[i] / 3][around.corners[i] % 3];
      if (normal & kLocal) normal = static_cast<uint32_t>(base[chunk] + (normal & ~kLocal));
    }
  });
}

}  // namespace hybridrt
