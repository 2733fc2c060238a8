#include "core/load/om_chunks.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>

#include "core/base/error.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

constexpr size_t kHeaderBytes = 16, kLeastVertexBytes = 12;
constexpr unsigned kNewestMajor = 2, kNewestMinor = 2;

enum Entity : unsigned { vertex = 0, mesh = 1, face = 2, edge = 4, halfedge = 6, end_mark = 7 };
enum Type : unsigned { position = 0, normal = 1, texcoord = 2, status = 3, color = 4, custom = 6, topology = 7 };

/// A chunk's 16 bits.
struct ChunkHead {
  explicit ChunkHead(unsigned bits)
      : named(bits >> 1 & 1),
        entity(bits >> 2 & 7),
        type(bits >> 5 & 15),
        is_float(bits >> 10 & 1),
        dimensions((bits >> 11 & 7) + 1),
        size_code(bits >> 14 & 3) {}

  bool named;
  unsigned entity, type;
  bool is_float;
  unsigned dimensions, size_code;

  uint64_t integer_bytes() const { return uint64_t{1} << size_code; }
  uint64_t vector_bytes() const { return dimensions * (is_float ? uint64_t{4} << size_code : integer_bytes()); }
};

class Walk {
 public:
  Walk(const fs::path& path, std::string bytes, Warnings& warnings)
      : path_(path), bytes_(std::move(bytes)), warnings_(warnings) {}

  OmFile read() {
    read_header();
    while (read_chunk()) {
    }
    if (!seen_.contains({vertex, position})) fail("it has no positions");
    if (!seen_.contains({face, topology}) || (file_.by_halfedges && !seen_.contains({halfedge, topology})))
      fail("it has no faces");
    const unsigned char end[] = {end_mark << 2, 0};
    file_.bytes.append(reinterpret_cast<const char*>(end), sizeof end);
    const auto tell = [&](WarningCode code, size_t count, const char* what) {
      if (count > 0) warnings_.emplace_back(code, fmt::format("{}: {} were left out", path_.filename().string(), what));
    };
    tell(WarningCode::texcoord_unread, texcoords_, "texture coordinates (OM names no texture)");
    tell(WarningCode::data_unread, customs_, "properties of the program that wrote it");
    tell(WarningCode::data_unread, others_, "status bits, normals of faces and the like");
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw error(ErrorKind::input, "{}: {}; write the file again", path_.string(), problem);
  }

  void require(uint64_t bytes) const {
    if (bytes > bytes_.size() - at_) fail("it is cut short, or its counts are wrong");
  }

  /// Moves on.
  std::string_view take(uint64_t bytes) {
    require(bytes);
    at_ += bytes;
    return std::string_view(bytes_).substr(at_ - bytes, bytes);
  }

  uint32_t number(size_t bytes) {
    uint32_t value = 0;
    const std::string_view taken = take(bytes);
    for (size_t i = 0; i < bytes; ++i) value |= uint32_t{static_cast<unsigned char>(taken[i])} << 8 * i;
    return value;
  }

  void read_header() {
    if (take(2) != "OM") fail("it is no OM file");
    file_.kind = take(1)[0];
    if (std::string_view("TQP").find(file_.kind) == std::string_view::npos) fail("it is no OM file");
    const unsigned version = number(1), major = version >> 5, minor = version & 31;
    if (major > kNewestMajor || (major == kNewestMajor && minor > kNewestMinor) || major == 0)
      fail(fmt::format("it is of version {}.{}, and 1.0 to {}.{} are read", major, minor, kNewestMajor, kNewestMinor));
    file_.by_halfedges = major >= 2;
    properties_have_types_ = major == 2 && minor >= 2;
    file_.vertices = number(4), file_.faces = number(4), file_.edges = number(4);
    require(uint64_t{file_.vertices} * kLeastVertexBytes);
    file_.bytes = bytes_.substr(0, kHeaderBytes);
  }

  /// False at the end.
  bool read_chunk() {
    if (at_ == bytes_.size()) return false;
    const size_t begin = at_;
    const ChunkHead head(number(2));
    if (head.entity == end_mark) return false;
    if (head.named)
      for (int names = properties_have_types_ ? 2 : 1; names > 0; --names) take(number(1));
    if (head.type == custom) {
      take(number(4));
      ++customs_;
      return true;
    }
    const bool keep = skip_data(head);
    if (!keep) return true;
    if (head.named) fail("a chunk that it needs has a name");
    if (!seen_.insert({head.entity, head.type}).second) fail("it holds a chunk twice");
    file_.bytes.append(bytes_, begin, at_ - begin);
    return true;
  }

  uint64_t count_of(unsigned entity) const {
    switch (entity) {
      case vertex: return file_.vertices;
      case face: return file_.faces;
      case edge: return file_.edges;
      case halfedge: return 2 * uint64_t{file_.edges};
      case mesh: return 1;
      default: fail("it holds a chunk of an unknown kind");
    }
  }

  /// Whether the chunk is one that we read.
  bool skip_data(const ChunkHead& head) {
    const uint64_t count = count_of(head.entity);
    if (head.type == topology) return skip_topology(head, count);
    if (head.type == status) return take(4 * count), ++others_, false;
    take(count * head.vector_bytes());
    const bool is_vector = head.is_float && head.dimensions == 3 && head.size_code <= 1;
    const bool is_color = !head.is_float && head.dimensions == 3 && head.size_code == 0;
    if (head.entity == vertex && head.type == position) {
      if (!is_vector) fail("its positions are not three floats or doubles");
      return true;
    }
    if (head.entity == vertex && head.type == normal && is_vector) return file_.normals = true;
    if (head.entity == vertex && head.type == color && is_color) return file_.vertex_colors = true;
    if (head.entity == face && head.type == color && is_color) return file_.face_colors = true;
    ++(head.type == texcoord ? texcoords_ : others_);
    return false;
  }

  bool skip_topology(const ChunkHead& head, uint64_t count) {
    if (head.size_code > 2) fail("its indices have more than 32 bits");
    const uint64_t bytes = head.integer_bytes();
    if (file_.by_halfedges) {
      take(count * bytes * (head.entity == halfedge ? 3 : 1));  // next, vertex and face of each half-edge
      return head.entity == halfedge || head.entity == face;
    }
    if (head.entity != face) fail("it holds a chunk of an unknown kind");
    if (file_.kind != 'P') return take(count * bytes * (file_.kind == 'T' ? 3 : 4)), true;
    for (uint64_t f = 0; f < count; ++f) take(number(2) * bytes);
    return true;
  }

  const fs::path path_;
  const std::string bytes_;
  Warnings& warnings_;
  size_t at_ = 0;
  OmFile file_;
  bool properties_have_types_ = false;
  std::set<std::pair<unsigned, unsigned>> seen_;
  size_t texcoords_ = 0, customs_ = 0, others_ = 0;
};

std::string contents_of(const fs::path& path, uint64_t most_bytes) {
  std::ifstream file(path, std::ios::binary);
  std::error_code problem;
  const uint64_t size = fs::file_size(path, problem);
  if (!file || problem) throw error(ErrorKind::input, "{} cannot be opened", path.string());
  std::string bytes(std::min(size, most_bytes), 0);
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw error(ErrorKind::input, "{} cannot be read", path.string());
  return bytes;
}

}  // namespace

OmCounts read_om_counts(const fs::path& path) {
  const std::string head = contents_of(path, kHeaderBytes);
  if (head.size() < kHeaderBytes) return {};
  const auto number = [&](size_t at) {
    uint64_t value = 0;
    for (size_t i = 0; i < 4; ++i) value |= uint64_t{static_cast<unsigned char>(head[at + i])} << 8 * i;
    return value;
  };
  const uint64_t size = fs::file_size(path);
  return {std::min(number(4), size / kLeastVertexBytes), std::min(number(8), size)};
}

OmFile read_om_chunks(const fs::path& path, Warnings& warnings) {
  return Walk(path, contents_of(path, std::numeric_limits<uint64_t>::max()), warnings).read();
}

}  // namespace hybridrt
