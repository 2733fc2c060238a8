#include <atomic>
#include <limits>
#include <utility>

#include "core/base/check.h"
#include "core/scene/light_axes.h"
#include "core/trace/light_cells.h"
#include "core/trace/triangle.h"

namespace hybridrt {
namespace {

constexpr size_t kTrianglesPerChunk = 4096;
constexpr int kRowsPerChunk = 4;
// A triangle over a cell takes 12 bytes while the buffer is built, and up to 32 afterwards. Ordinary scenes have about
// three such pairs per triangle.
constexpr uint64_t kMostReferences = 1 << 20, kMostReferencesPerTriangle = 16;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr uint32_t kLastTriangle = (1u << 28) - 1;

enum class Facing : uint8_t {
  nothing,  ///< zero area
  toward,   ///< the light sees its outer side or, if it has none, its counterclockwise side
  away,
  unsure,  ///< rounding might decide
};

Facing facing_of(const Scene& scene, uint32_t triangle, int8_t side, const dvec3& toward) {
  const vec3 a = scene.vertex(triangle, 0), b = scene.vertex(triangle, 1), c = scene.vertex(triangle, 2);
  if (is_degenerate(a, b, c)) return Facing::nothing;
  const dvec3 e1 = dvec3(b) - dvec3(a), e2 = dvec3(c) - dvec3(a);
  const double facing = (side < 0 ? -1 : 1) * glm::dot(glm::cross(e1, e2), toward);
  const double rounding = 0x1p-46 * glm::length(e1) * glm::length(e2);
  if (std::abs(facing) <= rounding) return Facing::unsure;
  return facing > 0 ? Facing::toward : Facing::away;
}

class Builder {
 public:
  Builder(LightBuffer& buffer, const Sheets& sheets, ThreadPool& pool)
      : buffer_(buffer),
        scene_(*buffer.scene),
        sheets_(sheets),
        pool_(pool),
        positions_light_(scene_.positions.size()),
        facings_(scene_.triangle_count()) {}

  void run() {
    transform_positions();
    find_facings();
    for (double side = finest_cells(); set_grid(side), !count(); side *= 2) {
    }
    fill();
    make_entries();
  }

 private:
  /// A triangle over a cell, before it becomes an entry.
  struct Reference {
    float nearest, farthest;
    uint32_t triangle : 28;
    uint32_t touches : 1;   ///< the cell, certainly
    uint32_t ends : 1;      ///< its sheet may end in the cell
    uint32_t centered : 1;  ///< the cell's centre lies in it
    uint32_t unsure : 1;    ///< or may lie in it
    bool operator<(const Reference& other) const {
      return nearest != other.nearest ? nearest < other.nearest : triangle < other.triangle;
    }
  };

  size_t index_of(int x, int y) const { return static_cast<size_t>(y) * buffer_.cells_x + x; }

  template <typename Body>
  void for_each_chunk(const Body& body) {
    parallel_for(pool_, facings_.size(), kTrianglesPerChunk, body);
  }
  template <typename Body>
  void for_each_triangle(size_t begin, size_t end, const Body& body) const {
    for (size_t i = begin; i < end; ++i)
      if (facings_[i] != Facing::nothing) body(static_cast<uint32_t>(i), grid_triangle(static_cast<uint32_t>(i)));
  }

  GridTriangle grid_triangle(uint32_t triangle) const {
    const uvec3& corners = scene_.triangle_positions[triangle];
    return {grid_from_light(buffer_, positions_light_[corners.x]),
            grid_from_light(buffer_, positions_light_[corners.y]),
            grid_from_light(buffer_, positions_light_[corners.z])};
  }

  /// False for the half of closed bodies by which rays toward the light leave them.
  bool makes_entries(uint32_t triangle) const {
    return sheets_.sides[triangle] == 0 || facings_[triangle] != Facing::toward;
  }

  /// Bit k: the triangle's sheet may end at its side k, as the light sees it.
  unsigned ends_of_sheet(uint32_t triangle) const {
    unsigned ends = 0;
    for (int k = 0; k < 3; ++k) {
      const uint32_t next = sheets_.across[triangle][k];
      const bool goes_on =
          next != kNoTriangle && facings_[next] == facings_[triangle] && facings_[next] != Facing::unsure;
      ends |= static_cast<unsigned>(!goes_on) << k;
    }
    return ends;
  }

  void transform_positions() {
    parallel_for(pool_, positions_light_.size(), kTrianglesPerChunk, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) positions_light_[i] = light_from_scene(buffer_, dvec3(scene_.positions[i]));
    });
  }

  void find_facings() {
    const size_t chunks = (facings_.size() + kTrianglesPerChunk - 1) / kTrianglesPerChunk;
    std::vector<std::pair<dvec3, dvec3>> bounds(chunks, {dvec3(1e300), dvec3(-1e300)});
    std::atomic<size_t> kept = 0;
    parallel_for(pool_, facings_.size(), kTrianglesPerChunk, [&](size_t begin, size_t end) {
      auto& [lo, hi] = bounds[begin / kTrianglesPerChunk];
      size_t kept_here = 0;
      for (size_t i = begin; i < end; ++i) {
        const auto triangle = static_cast<uint32_t>(i);
        facings_[i] = facing_of(scene_, triangle, sheets_.sides[i], buffer_.toward);
        if (facings_[i] == Facing::nothing) continue;
        kept_here += makes_entries(triangle);
        for (int corner = 0; corner < 3; ++corner) {
          const dvec3& p = positions_light_[scene_.triangle_positions[i][corner]];
          lo = glm::min(lo, p), hi = glm::max(hi, p);
        }
      }
      kept += kept_here;
    });
    for (const auto& [lo, hi] : bounds) lo_ = glm::min(lo_, lo), hi_ = glm::max(hi_, hi);
    kept_ = kept;
  }

  /// The grid's side for half as many cells as triangles that make entries: measured, see docs/results/trace.md.
  double finest_cells() const {
    const dvec3 size = glm::max(hi_ - lo_, dvec3(0));
    const double wanted = std::clamp(0.5 * static_cast<double>(kept_), 64.0 * 64, 2048.0 * 2048);
    const double longest = std::max({size.x, size.y, 1e-300});
    return kept_ > 0 ? std::max(std::sqrt(size.x * size.y / wanted), longest / 4096) : longest;
  }

  void set_grid(double side) {
    const dvec3 size = glm::max(hi_ - lo_, dvec3(0));
    buffer_.cells_per_unit = 1 / side;
    buffer_.corner = dvec2(lo_) - 0.01 * side;
    buffer_.cells_x = static_cast<int>(size.x / side + 0.02) + 1;
    buffer_.cells_y = static_cast<int>(size.y / side + 0.02) + 1;
    const double depth = std::max(std::abs(lo_.z), std::abs(hi_.z));
    buffer_.depth_per_unit = depth > 0 ? 1 / depth : 1;
    buffer_.cells.assign(static_cast<size_t>(buffer_.cells_x) * buffer_.cells_y + 1, {0, kInfinity, kInfinity, 0, 0});
  }

  /// Finds where each cell's references begin; false if there are too many, as when thousands of triangles each cover
  /// most of the scene.
  bool count() {
    const uint64_t most = kMostReferences + kMostReferencesPerTriangle * facings_.size();
    std::atomic<uint64_t> total = 0;
    first_.assign(buffer_.cells.size(), 0);
    first_other_.assign(buffer_.cells.size(), 0);
    for_each_chunk([&](size_t begin, size_t end) {
      uint64_t counted = total;
      const uint64_t before = counted;
      for_each_triangle(begin, end, [&](uint32_t triangle, const GridTriangle& shape) {
        if (counted > most) return;
        std::vector<uint32_t>& numbers = makes_entries(triangle) ? first_ : first_other_;
        for_each_cell(shape, buffer_.cells_x, buffer_.cells_y, [&](int x, int y) {
          std::atomic_ref(numbers[index_of(x, y)]).fetch_add(1, std::memory_order_relaxed);
          ++counted;
        });
      });
      total += counted - before;
    });
    if (total > most && buffer_.cells.size() > 2) return false;
    references_.resize(begin_each(first_));
    others_.resize(begin_each(first_other_));
    return true;
  }

  /// Turns counts into first indices (a prefix sum); returns the total.
  static uint32_t begin_each(std::vector<uint32_t>& numbers) {
    uint64_t total = 0;
    for (uint32_t& number : numbers) total += std::exchange(number, static_cast<uint32_t>(total));
    HRT_CHECK(total < 0xFFFFFFFFu);
    return static_cast<uint32_t>(total);
  }

  void fill() {
    std::vector<uint32_t> next = first_, next_other = first_other_;
    for_each_chunk([&](size_t begin, size_t end) {
      for_each_triangle(begin, end, [&](uint32_t triangle, const GridTriangle& shape) {
        const bool is_other = !makes_entries(triangle);
        const bool holes = scene_.has_holes(triangle);
        const unsigned ends = ends_of_sheet(triangle);
        for_each_cell(shape, buffer_.cells_x, buffer_.cells_y, [&](int x, int y) {
          const size_t cell = index_of(x, y);
          const uint32_t place =
              std::atomic_ref((is_other ? next_other : next)[cell]).fetch_add(1, std::memory_order_relaxed);
          const CellView view(shape, x, y);
          if (is_other) {
            others_[place] = {view.nearest(), triangle};
            return;
          }
          const std::optional<bool> centered = view.centered();
          references_[place] = {view.nearest(),
                                view.farthest(),
                                triangle,
                                view.surely_touched(),
                                holes || view.crossed_by_sides(ends),
                                centered.value_or(false),
                                !centered};
          if (view.covers() && !holes) lower(buffer_.cells[cell].cover, view.farthest());
        });
      });
    });
  }

  static void lower(float& value, float candidate) {
    std::atomic_ref<float> shared(value);
    float seen = shared.load(std::memory_order_relaxed);
    while (candidate < seen && !shared.compare_exchange_weak(seen, candidate, std::memory_order_relaxed)) {
    }
  }

  struct SheetCover {
    float farthest = kInfinity;  ///< what lies deeper is in shadow
    bool single = false;         ///< it is the nearest sheet and covers the cell once
  };

  /// Triangles whose depths overlap, one after the other, are one sheet or several. If such a group has a point in the
  /// cell and no end in it, it covers the whole cell, however small its triangles are, and the number of layers is the
  /// same at all points of the cell, its centre among them.
  static SheetCover cover_by_sheets(std::span<const Reference> nearest_first) {
    bool touches = false, ends = false, unsure = false, is_nearest = true;
    int at_center = 0;
    float farthest = -kInfinity;
    const auto covers = [&] { return touches && !ends; };
    const auto cover = [&] { return SheetCover{farthest, is_nearest && !unsure && at_center == 1}; };
    for (const Reference& next : nearest_first) {
      if (next.nearest > farthest && farthest > -kInfinity) {
        if (covers()) return cover();
        touches = ends = unsure = is_nearest = false;
        at_center = 0;
      }
      touches |= next.touches, ends |= next.ends, unsure |= next.unsure;
      at_center += next.centered;
      farthest = std::max(farthest, next.farthest);
    }
    return covers() ? cover() : SheetCover{};
  }

  template <typename Body>
  void for_each_cell_of_grid(const Body& body) {
    parallel_for(pool_, buffer_.cells.size() - 1, static_cast<size_t>(buffer_.cells_x) * kRowsPerChunk,
                 [&](size_t begin, size_t end) {
                   for (size_t cell = begin; cell < end; ++cell) body(cell);
                 });
  }

  /// Sorts each cell's references and makes entries of those that a query may reach.
  void make_entries() {
    std::vector<uint32_t> first_entry(buffer_.cells.size()), first_other(buffer_.cells.size());
    for_each_cell_of_grid([&](size_t cell) {
      const auto first = references_.begin() + first_[cell], last = references_.begin() + first_[cell + 1];
      std::sort(first, last);
      const SheetCover sheet = cover_by_sheets({first, last});
      buffer_.cells[cell].single = sheet.single;
      buffer_.cells[cell].cover = std::min(buffer_.cells[cell].cover, sheet.farthest);
      const Reference at_cover{buffer_.cells[cell].cover, 0, kLastTriangle, 0, 0, 0, 0};
      first_entry[cell] = static_cast<uint32_t>(std::upper_bound(first, last, at_cover) - first);
      first_other[cell] =
          first_other_[cell + 1] - first_other_[cell] + static_cast<uint32_t>(last - first) - first_entry[cell];
    });
    const uint32_t entries = begin_each(first_entry), others = begin_each(first_other);
    HRT_CHECK(others < 1u << 31);
    buffer_.others.resize(others);
    buffer_.entries.resize(entries);
    for_each_cell_of_grid([&](size_t cell) {
      buffer_.cells[cell].first = first_entry[cell];
      buffer_.cells[cell].first_other = first_other[cell];
      if (first_entry[cell] < first_entry[cell + 1]) buffer_.cells[cell].nearest = references_[first_[cell]].nearest;
      const int x = static_cast<int>(cell % buffer_.cells_x), y = static_cast<int>(cell / buffer_.cells_x);
      auto reference = references_.begin() + first_[cell];
      for (uint32_t entry = first_entry[cell]; entry < first_entry[cell + 1]; ++entry, ++reference) {
        const GridTriangle triangle = grid_triangle(reference->triangle);
        buffer_.entries[entry] =
            CellView(triangle, x, y).entry(reference->triangle, scene_.has_holes(reference->triangle));
      }
      const auto begin = buffer_.others.begin() + first_other[cell];
      auto other = std::copy(others_.begin() + first_other_[cell], others_.begin() + first_other_[cell + 1], begin);
      for (; reference != references_.begin() + first_[cell + 1]; ++reference)
        *other++ = {reference->nearest, reference->triangle};
      std::sort(begin, other);
    });
    buffer_.cells.back().first = entries;
    buffer_.cells.back().first_other = static_cast<uint32_t>(buffer_.others.size());
  }

  LightBuffer& buffer_;
  const Scene& scene_;
  const Sheets& sheets_;
  ThreadPool& pool_;
  UninitializedVector<dvec3> positions_light_;
  std::vector<Facing> facings_;
  std::vector<uint32_t> first_, first_other_;  ///< per cell, its first place in the arrays below
  UninitializedVector<Reference> references_;
  UninitializedVector<LightOther> others_;
  dvec3 lo_{1e300}, hi_{-1e300};  ///< light space
  size_t kept_ = 0;
};

}  // namespace

LightBuffer build_light_buffer(const Scene& scene, const Sheets& sheets, const dvec3& toward, ThreadPool& pool) {
  HRT_CHECK_EQ(sheets.sides.size(), scene.triangle_count());
  HRT_CHECK(scene.triangle_count() <= kLastTriangle);
  LightBuffer buffer;
  buffer.scene = &scene;
  buffer.sides = sheets.sides;
  buffer.toward = toward;
  const LightAxes axes = light_axes(toward);
  buffer.x_axis = axes.x;
  buffer.y_axis = axes.y;
  buffer.center = dvec3(scene.bounds.empty() ? vec3(0) : scene.bounds.center());
  Builder(buffer, sheets, pool).run();
  return buffer;
}

size_t memory_bytes(const LightBuffer& buffer) {
  return buffer.cells.size() * sizeof(LightCell) + buffer.entries.size() * sizeof(LightEntry) +
         buffer.others.size() * sizeof(LightOther);
}

}  // namespace hybridrt
