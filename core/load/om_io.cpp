#include "core/load/om_io.h"

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/OMReader.hh>
#include <mutex>
#include <sstream>

#include "core/base/error.h"
#include "core/load/mesh_builder.h"
#include "core/load/om_chunks.h"

namespace hybridrt {
namespace {

using namespace OpenMesh;

/// What the reader finds, as it comes. Elements that it names are those of the header's counts; anything else is left
/// for read_om() to refuse.
class Collector final : public IO::BaseImporter {
 public:
  explicit Collector(const OmFile& file) : halfedges(file.by_halfedges ? 2 * size_t{file.edges} : 0) {
    if (file.normals) normals.resize(file.vertices);
    if (file.vertex_colors) colors.resize(file.vertices);
    if (file.face_colors) face_colors.resize(file.faces);
  }

  struct Halfedge {
    uint32_t next = kNoIndex, to = kNoIndex;
  };
  std::vector<dvec3> positions, normals, colors, face_colors;
  std::vector<std::vector<uint32_t>> faces;  ///< by vertices
  std::vector<Halfedge> halfedges;           ///< or by half-edges,
  std::vector<uint32_t> halfedge_of_face;    ///< one of each face

  VertexHandle add_vertex(const Vec3f& p) override { return add_vertex(Vec3d(p)); }
  VertexHandle add_vertex(const Vec3d& p) override {
    positions.emplace_back(p[0], p[1], p[2]);
    return VertexHandle(static_cast<int>(positions.size()) - 1);
  }
  VertexHandle add_vertex() override { return add_vertex(Vec3d(0, 0, 0)); }
  HalfedgeHandle add_edge(VertexHandle from, VertexHandle to) override {
    const size_t edge = edges_++;
    set(halfedges, 2 * edge, [&](Halfedge& halfedge) { halfedge.to = index(to); });
    set(halfedges, 2 * edge + 1, [&](Halfedge& halfedge) { halfedge.to = index(from); });
    return HalfedgeHandle(static_cast<int>(2 * edge));
  }
  void set_next(HalfedgeHandle halfedge, HalfedgeHandle next) override {
    set(halfedges, index(halfedge), [&](Halfedge& to) { to.next = index(next); });
  }
  FaceHandle add_face(const VHandles& vertices) override {
    std::vector<uint32_t>& face = faces.emplace_back();
    for (VertexHandle vertex : vertices) face.push_back(index(vertex));
    return FaceHandle(static_cast<int>(faces.size()) - 1);
  }
  FaceHandle add_face(HalfedgeHandle halfedge) override {
    halfedge_of_face.push_back(index(halfedge));
    return FaceHandle(static_cast<int>(halfedge_of_face.size()) - 1);
  }
  void set_normal(VertexHandle vertex, const Vec3f& n) override { set_normal(vertex, Vec3d(n)); }
  void set_normal(VertexHandle vertex, const Vec3d& n) override {
    set(normals, index(vertex), [&](dvec3& to) { to = {n[0], n[1], n[2]}; });
  }
  void set_color(VertexHandle vertex, const Vec3uc& c) override {
    set(colors, index(vertex), [&](dvec3& to) { to = {c[0], c[1], c[2]}; });
  }
  void set_color(FaceHandle face, const Vec3uc& c) override {
    set(face_colors, index(face), [&](dvec3& to) { to = {c[0], c[1], c[2]}; });
  }

  // The reader refuses importers without a kernel, which holds properties that read_om_chunks() has left out.
  BaseKernel* kernel() override { return &kernel_; }
  size_t n_vertices() const override { return positions.size(); }
  size_t n_faces() const override { return faces.size() + halfedge_of_face.size(); }
  size_t n_edges() const override { return edges_; }

  // What read_om_chunks() has left out, and what faces as cycles do not need.
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec2f>&) override {}
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec3f>&) override {}
  void set_face_texindex(FaceHandle, int) override {}
  void set_point(VertexHandle, const Vec3f&) override {}
  void set_halfedge(VertexHandle, HalfedgeHandle) override {}
  void set_face(HalfedgeHandle, FaceHandle) override {}
  void set_color(VertexHandle, const Vec4uc&) override {}
  void set_color(VertexHandle, const Vec3f&) override {}
  void set_color(VertexHandle, const Vec4f&) override {}
  void set_texcoord(VertexHandle, const Vec2f&) override {}
  void set_texcoord(HalfedgeHandle, const Vec2f&) override {}
  void set_texcoord(VertexHandle, const Vec3f&) override {}
  void set_texcoord(HalfedgeHandle, const Vec3f&) override {}
  void set_status(VertexHandle, const Attributes::StatusInfo&) override {}
  void set_status(HalfedgeHandle, const Attributes::StatusInfo&) override {}
  void set_status(EdgeHandle, const Attributes::StatusInfo&) override {}
  void set_status(FaceHandle, const Attributes::StatusInfo&) override {}
  void request_face_texcoords2D() override {}
  void set_color(EdgeHandle, const Vec3uc&) override {}
  void set_color(EdgeHandle, const Vec4uc&) override {}
  void set_color(EdgeHandle, const Vec3f&) override {}
  void set_color(EdgeHandle, const Vec4f&) override {}
  void set_normal(FaceHandle, const Vec3f&) override {}
  void set_normal(FaceHandle, const Vec3d&) override {}
  void set_color(FaceHandle, const Vec4uc&) override {}
  void set_color(FaceHandle, const Vec3f&) override {}
  void set_color(FaceHandle, const Vec4f&) override {}
  void add_texture_information(int, std::string) override {}

 private:
  static uint32_t index(BaseHandle handle) { return static_cast<uint32_t>(handle.idx()); }
  template <typename Element, typename Change>
  static void set(std::vector<Element>& elements, size_t at, const Change& change) {
    if (at < elements.size()) change(elements[at]);
  }

  BaseKernel kernel_;
  size_t edges_ = 0;
};

bool collect(const OmFile& file, Collector& collector) {
  static std::mutex one_at_a_time;  // the reader is one object, with members that it changes
  const std::lock_guard lock(one_at_a_time);
  std::istringstream stream(file.bytes);
  stream.unsetf(std::ios::skipws);
  IO::Options options(IO::Options::VertexNormal | IO::Options::VertexColor | IO::Options::FaceColor);
  return IO::OMReader().read(stream, collector, options);
}

/// The vertices around each face: a walk over half-edges that meets none twice.
std::vector<std::vector<uint32_t>> faces_of_halfedges(const Collector& found, const MeshBuilder& mesh) {
  std::vector<std::vector<uint32_t>> faces;
  std::vector<bool> met(found.halfedges.size(), false);
  for (const uint32_t first : found.halfedge_of_face) {
    std::vector<uint32_t>& face = faces.emplace_back();
    uint32_t at = first;
    do {
      if (at >= met.size() || met[at]) mesh.fail(faces.size() - 1, "its half-edges are no cycle; write the file again");
      met[at] = true;
      face.push_back(found.halfedges[at].to);
      at = found.halfedges[at].next;
    } while (at != first);
  }
  return faces;
}

}  // namespace

MeshData read_om(const std::filesystem::path& path, Warnings& warnings) {
  const OmFile file = read_om_chunks(path, warnings);
  Collector found(file);
  MeshBuilder mesh(path, "face");
  if (!collect(file, found) || found.positions.size() != file.vertices || found.n_faces() != file.faces)
    throw error(ErrorKind::input, "{}: OpenMesh cannot read it; write the file again", path.string());
  for (size_t i = 0; i < found.positions.size(); ++i) mesh.add_vertex(found.positions[i], i);
  for (const dvec3& n : found.normals) mesh.add_normal(n);
  for (const dvec3& c : found.colors) mesh.data.colors.emplace_back(c);
  if (file.vertex_colors) mesh.data.color_full = 255;
  if (file.face_colors) mesh.face_color_full = 255;

  const auto faces = file.by_halfedges ? faces_of_halfedges(found, mesh) : std::move(found.faces);
  for (size_t f = 0; f < faces.size(); ++f) {
    for (const uint32_t vertex : faces[f]) mesh.corner(vertex, file.vertices, f);  // refuses what is none
    MeshBuilder::FaceExtras extras;
    if (file.face_colors) extras.color = mesh.add_face_color(vec3(found.face_colors[f]));
    mesh.add_face(faces[f], f, extras);
  }
  return mesh.finish(warnings);
}

}  // namespace hybridrt
