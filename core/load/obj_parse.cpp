#include "core/load/obj_parse.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <unordered_map>

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/load/mesh_colors.h"
#include "core/load/obj_chunk.h"
#include "core/load/text_blocks.h"
#include "core/mesh/polygon.h"

namespace hybridrt {
namespace {

constexpr size_t kChunksPerThread = 2;  // read together, as some are slower than others

/// Consecutive chunks of whole lines, each about `bytes` long.
std::vector<ObjChunk> cut_into_chunks(std::string_view text, size_t bytes) {
  std::vector<ObjChunk> chunks;
  while (!text.empty()) {
    size_t size = 0;
    for (size_t wanted = bytes; size == 0 && wanted < text.size(); wanted *= 2)
      size = whole_lines(text.substr(0, wanted), LineJoin::obj, true);
    if (size == 0) size = text.size();
    chunks.emplace_back().text = text.substr(0, size);
    text.remove_prefix(size);
  }
  return chunks;
}

void add(Tally& sum, const Tally& part) {
  if (part.count > 0) sum.add(part.first_line, part.count);
}

/// Cuts the polygons whose corners are all known, and removes them from the list. Those with an unusable corner stay as
/// they are: they will be refused.
void cut_polygons(ObjChunk& chunk, MeshData& data, Tally& tangled) {
  std::vector<dvec3> points;
  std::vector<uvec3> cuts;
  std::erase_if(chunk.polygons, [&](const ObjChunk::Polygon& polygon) {
    if (polygon.farthest >= data.positions.size()) return false;
    const auto corners = std::span(chunk.polygon_corners).subspan(polygon.first_corner, polygon.corners);
    points.clear(), cuts.clear();
    for (const ObjChunk::Corner& corner : corners) points.push_back(data.positions[corner.position]);
    if (!std::all_of(points.begin(), points.end(), [](const dvec3& p) { return is_usable(p); })) return true;
    if (!triangulate_polygon(points, cuts)) tangled.add(polygon.line);
    for (size_t i = 0; i < cuts.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const ObjChunk::Corner& corner = corners[cuts[i][k]];
        data.triangle_positions[polygon.first_triangle + i][k] = corner.position;
        if (!data.triangle_normals.empty()) data.triangle_normals[polygon.first_triangle + i][k] = corner.normal;
        if (!data.triangle_texcoords.empty()) data.triangle_texcoords[polygon.first_triangle + i][k] = corner.texcoord;
      }
    return true;
  });
}

/// The chunks read so far, joined in order.
class Joined {
 public:
  Joined(const std::filesystem::path& path, uint64_t file_bytes) : file_bytes_(file_bytes) {
    data_.path = path;
    material_ids_.emplace("", 0);
  }

  void append(std::vector<ObjChunk>& chunks, ThreadPool& pool);
  /// `counts`: the counts of the whole file.
  MeshData finish(const ObjCounts& counts, Warnings& warnings);

 private:
  void take_facts(ObjChunk& chunk);
  template <typename T>
  void append_array(const std::vector<ObjChunk>& chunks, std::vector<T> MeshData::*array);
  void append_materials(const std::vector<ObjChunk>& chunks);
  void append_colors(const std::vector<ObjChunk>& chunks);
  void take_polypaint(Warnings& warnings);
  void append_optional_indices(const std::vector<ObjChunk>& chunks, std::vector<uvec3> MeshData::*array);
  template <typename T>
  void make_room(std::vector<T>& all, size_t more) const;

  const uint64_t file_bytes_;
  uint64_t bytes_ = 0;
  MeshData data_;
  std::unordered_map<std::string, uint32_t> material_ids_;
  uint32_t material_ = 0;
  std::vector<std::vector<uint32_t>> meanings_;  ///< per chunk: what its material numbers mean
  ObjChunk waiting_;                             ///< only its polygons, which name vertices that come later
  ObjChunk::Ahead farthest_;
  std::vector<ObjChunk::Ahead> texcoords_ahead_, normals_ahead_;
  std::vector<BadVertex> bad_vertices_;
  std::vector<uint32_t> polypaint_;
  Tally unread_texcoords_, bad_texcoords_, bad_normals_, small_faces_, unknown_, tangled_, bad_colors_, bad_polypaint_;
};

/// Makes room for `more`, and the first time for what the rest of the file will need if it goes on like this: untouched
/// memory costs nothing, moving does.
template <typename T>
void Joined::make_room(std::vector<T>& all, size_t more) const {
  if (all.capacity() > 0 || bytes_ == 0) return;
  const double share = static_cast<double>(file_bytes_) / static_cast<double>(bytes_);
  all.reserve(static_cast<size_t>(static_cast<double>(more) * std::max(1.0, 1.02 * share)));
}

template <typename T>
void Joined::append_array(const std::vector<ObjChunk>& chunks, std::vector<T> MeshData::*array) {
  size_t more = 0;
  for (const ObjChunk& chunk : chunks) more += (chunk.data.*array).size();
  std::vector<T>& all = data_.*array;
  make_room(all, more);
  for (const ObjChunk& chunk : chunks) all.insert(all.end(), (chunk.data.*array).begin(), (chunk.data.*array).end());
}

void Joined::append_materials(const std::vector<ObjChunk>& chunks) {
  size_t more = 0;
  for (const ObjChunk& chunk : chunks) more += chunk.data.triangle_materials.size();
  std::vector<uint32_t>& all = data_.triangle_materials;
  make_room(all, more);
  for (size_t i = 0; i < chunks.size(); ++i)
    for (uint32_t material : chunks[i].data.triangle_materials) all.push_back(meanings_[i][material]);
}

/// If a mesh has any normals (or texture coordinates), each triangle gets three indices.
void Joined::append_optional_indices(const std::vector<ObjChunk>& chunks, std::vector<uvec3> MeshData::*array) {
  std::vector<uvec3>& all = data_.*array;
  const auto has_some = [&](const ObjChunk& chunk) { return !(chunk.data.*array).empty(); };
  if (all.empty() && std::none_of(chunks.begin(), chunks.end(), has_some)) return;
  size_t triangles = data_.triangle_materials.size();  // before these chunks; nothing else appends meanwhile
  size_t more = 0;
  for (const ObjChunk& chunk : chunks) more += chunk.data.triangle_positions.size();
  make_room(all, more);
  all.resize(triangles, uvec3(kNoIndex));
  for (const ObjChunk& chunk : chunks) {
    all.insert(all.end(), (chunk.data.*array).begin(), (chunk.data.*array).end());
    all.resize(triangles += chunk.data.triangle_positions.size(), uvec3(kNoIndex));
  }
}

/// If a mesh has any colours, each vertex gets one.
void Joined::append_colors(const std::vector<ObjChunk>& chunks) {
  std::vector<vec3>& all = data_.colors;
  const auto has_some = [](const ObjChunk& chunk) { return !chunk.data.colors.empty(); };
  if (all.empty() && std::none_of(chunks.begin(), chunks.end(), has_some)) return;
  size_t vertices = data_.positions.size();  // before these chunks, as their positions are appended later
  size_t more = 0;
  for (const ObjChunk& chunk : chunks) more += chunk.data.positions.size();
  make_room(all, more);
  all.resize(vertices, kNoColor);
  for (const ObjChunk& chunk : chunks) {
    all.insert(all.end(), chunk.data.colors.begin(), chunk.data.colors.end());
    all.resize(vertices += chunk.data.positions.size(), kNoColor);
  }
}

/// Colours of `v` lines go before those of #MRGB comments.
void Joined::take_polypaint(Warnings& warnings) {
  const std::string file = data_.path.filename().string();
  report(WarningCode::color_unusable, bad_colors_,
         "vertices have colours that are not three usable numbers, which were left out", data_.path, warnings);
  report(WarningCode::color_unusable, bad_polypaint_,
         "lines #MRGB do not hold eight hexadecimal digits a vertex, and were read up to there", data_.path, warnings);
  if (polypaint_.empty()) return;
  if (!data_.colors.empty()) {
    warnings.emplace_back(WarningCode::color_ignored,
                          file + ": its #MRGB colours were left out, since its v lines have colours");
    return;
  }
  const size_t vertices = data_.positions.size();
  if (polypaint_.size() != vertices)
    warnings.emplace_back(WarningCode::color_miscounted,
                          fmt::format("{}: #MRGB gives {} colours for {} vertices; they are taken in order", file,
                                      polypaint_.size(), vertices));
  data_.color_full = 255;
  for (const uint32_t color : std::span(polypaint_).first(std::min(vertices, polypaint_.size())))
    data_.colors.emplace_back(color >> 16 & 255, color >> 8 & 255, color & 255);
  data_.colors.resize(vertices, kNoColor);
}

/// Takes over everything of a chunk but its large arrays.
void Joined::take_facts(ObjChunk& chunk) {
  std::vector<uint32_t>& meaning = meanings_.emplace_back(std::vector<uint32_t>{material_});
  for (size_t i = 1; i < chunk.data.material_names.size(); ++i) {
    const std::string& name = chunk.data.material_names[i];
    const auto [entry, is_new] = material_ids_.try_emplace(name, static_cast<uint32_t>(data_.material_names.size()));
    if (is_new) data_.material_names.push_back(name);
    meaning.push_back(entry->second);
  }
  material_ = meaning[chunk.last_material];

  std::move(chunk.data.libraries.begin(), chunk.data.libraries.end(), std::back_inserter(data_.libraries));
  data_.faces += chunk.data.faces;
  bytes_ += chunk.text.size();
  if (chunk.farthest.index > farthest_.index) farthest_ = chunk.farthest;
  texcoords_ahead_.insert(texcoords_ahead_.end(), chunk.texcoords_ahead.begin(), chunk.texcoords_ahead.end());
  normals_ahead_.insert(normals_ahead_.end(), chunk.normals_ahead.begin(), chunk.normals_ahead.end());
  bad_vertices_.insert(bad_vertices_.end(), chunk.bad_vertices.begin(), chunk.bad_vertices.end());
  add(unread_texcoords_, chunk.unread_texcoords), add(bad_texcoords_, chunk.bad_texcoords),
      add(bad_normals_, chunk.bad_normals);
  add(small_faces_, chunk.small_faces), add(unknown_, chunk.unknown), add(bad_colors_, chunk.bad_colors);
  add(bad_polypaint_, chunk.bad_polypaint);
  polypaint_.insert(polypaint_.end(), chunk.polypaint.begin(), chunk.polypaint.end());
}

void Joined::append(std::vector<ObjChunk>& chunks, ThreadPool& pool) {
  size_t first_triangle = data_.triangle_positions.size();
  meanings_.clear();
  for (ObjChunk& chunk : chunks) {
    if (chunk.failure) std::rethrow_exception(chunk.failure);
    take_facts(chunk);
    for (ObjChunk::Polygon& polygon : chunk.polygons) polygon.first_triangle += first_triangle;
    first_triangle += chunk.data.triangle_positions.size();
  }

  append_colors(chunks);
  append_optional_indices(chunks, &MeshData::triangle_normals);
  append_optional_indices(chunks, &MeshData::triangle_texcoords);
  pool.run(6, [&](size_t array, int) {
    switch (array) {
      case 0: return append_array(chunks, &MeshData::positions);
      case 1: return append_array(chunks, &MeshData::normals);
      case 2: return append_array(chunks, &MeshData::triangle_positions);
      case 3: return append_array(chunks, &MeshData::triangle_places);
      case 4: return append_materials(chunks);
      case 5: return append_array(chunks, &MeshData::texcoords);
    }
  });

  std::vector<Tally> tangled(chunks.size());
  pool.run(chunks.size(), [&](size_t i, int) { cut_polygons(chunks[i], data_, tangled[i]); });
  for (const Tally& part : tangled) add(tangled_, part);
  for (const ObjChunk& chunk : chunks)
    for (ObjChunk::Polygon polygon : chunk.polygons) {
      const auto corners = chunk.polygon_corners.begin() + static_cast<ptrdiff_t>(polygon.first_corner);
      polygon.first_corner = waiting_.polygon_corners.size();
      waiting_.polygon_corners.insert(waiting_.polygon_corners.end(), corners, corners + polygon.corners);
      waiting_.polygons.push_back(polygon);
    }
}

MeshData Joined::finish(const ObjCounts& counts, Warnings& warnings) {
  const std::filesystem::path& path = data_.path;
  if (farthest_.index > static_cast<int64_t>(counts.vertices))
    throw error(ErrorKind::input, "{}:{}: a face uses vertex {}, but the file has {} vertices; is it cut short?",
                path.string(), farthest_.line, farthest_.index, counts.vertices);
  for (const ObjChunk::Ahead& ahead : texcoords_ahead_)
    if (ahead.index > static_cast<int64_t>(counts.texcoords)) bad_texcoords_.add(ahead.line);
  for (const ObjChunk::Ahead& ahead : normals_ahead_)
    if (ahead.index > static_cast<int64_t>(counts.normals)) bad_normals_.add(ahead.line);
  cut_polygons(waiting_, data_, tangled_);
  if (const BadVertex* bad = settle_bad_vertices(data_, bad_vertices_, warnings))
    throw error(ErrorKind::input, "{}:{}: vertex {}: {}, and a face uses it; fix that line or export the mesh again",
                path.string(), bad->place, bad->vertex + 1, fault_of_position(data_.positions[bad->vertex]));

  report(WarningCode::face_too_small, small_faces_, "faces of fewer than three corners were left out", path, warnings);
  report(WarningCode::texcoord_unusable, unread_texcoords_,
         "texture coordinates are not usable numbers and were set to 0", path, warnings);
  report(WarningCode::texcoord_astray, bad_texcoords_, "texture coordinate indices lead nowhere and were left out",
         path, warnings);
  report(WarningCode::normal_astray, bad_normals_, "normal indices lead nowhere and were left out", path, warnings);
  report(WarningCode::line_unknown, unknown_, "lines of an unknown kind were left out", path, warnings);
  report(WarningCode::polygon_tangled, tangled_, "polygons cross themselves or have no area and were cut as they came",
         path, warnings);
  take_polypaint(warnings);
  return std::move(data_);
}

}  // namespace

MeshData parse_obj(const std::filesystem::path& path, ThreadPool& pool, Warnings& warnings, LoadProgress* progress,
                   size_t chunk_bytes) {
  TextBlocks blocks(path, LineJoin::obj);
  std::error_code unknown;
  const uint64_t file_bytes = std::filesystem::file_size(path, unknown);
  Joined joined(path, unknown ? 0 : file_bytes);
  ObjCounts counts;
  for (;;) {
    const std::string_view text = blocks.next(chunk_bytes * kChunksPerThread * static_cast<size_t>(pool.size()));
    if (text.empty()) break;
    std::vector<ObjChunk> chunks = cut_into_chunks(text, chunk_bytes);
    std::vector<ObjCounts> own(chunks.size());
    pool.run(chunks.size(), [&](size_t i, int) { own[i] = count_statements(path, chunks[i].text); });
    for (size_t i = 0; i < chunks.size(); ++i) chunks[i].before = counts, counts += own[i];
    pool.run(chunks.size(), [&](size_t i, int) { read_chunk(path, chunks[i]); });
    joined.append(chunks, pool);
    if (progress) progress->bytes_read += text.size();
  }
  return joined.finish(counts, warnings);
}

}  // namespace hybridrt
