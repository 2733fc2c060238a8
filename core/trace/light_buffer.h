#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/uninitialized.h"
#include "core/scene/scene.h"
#include "core/trace/sheets.h"

namespace hybridrt {

// The shadow rays of a directional light are parallel. Seen along the light they are points, so a query is a
// lookup in the plane: which triangles lie over this point, and is one of them nearer to the light? Source:
// the light buffer of Haines and Greenberg, "The Light Buffer: A Shadow-Testing Accelerator", IEEE CG&A 6(9),
// 1986.
//
// Light space: x and y across the light's direction, z along it, growing away from the light. A grid of cells in x and
// y lists the triangles over each cell, nearest first.
//
// Only half of a closed body is needed. A ray that starts outside it and reaches infinity enters it as often as it
// leaves it, so it meets the body exactly when it meets one of the triangles that it enters by, those that face away
// from the light. A lit surface then never finds itself or its neighbours in its way, and needs no bias. The other half
// is kept separately, for queries that may start inside something.

/// One triangle over one cell, in the cell's own coordinates: x and y in [-1, 1]. Lanes 0-2 of a x + b y + c are the
/// signed distances to the triangle's edges (positive inside), in units of 2^-14; lane 3 is `nearest` minus the depth
/// of its plane, times units_per_depth(). What is within its error of zero is decided in double precision. Half a cache
/// line.
struct alignas(32) LightEntry {
  int16_t a[4], b[4], c[4];
  float nearest;  ///< a lower bound of its depth over the cell; its lowest 8 bits hold the exponent of the depth's unit
  uint32_t triangle;

  static constexpr float kUnit = 0x1p-14f;

  // Three numbers are each rounded by half a unit. At edges x and y, truncated to 2^-15, and two products add 2.5 units
  // at most; planes are computed in single precision, which adds a quarter of a unit and, as a depth, 2^-19.
  static constexpr int kEdgeError = 5;
  static constexpr float kPlaneError = 2, kDepthError = 0x1p-19f;

  /// A power of two; 0 if only double precision decides.
  float units_per_depth() const {
    return std::bit_cast<float>((0xFFu - (std::bit_cast<uint32_t>(nearest) & 0xFFu)) << 23) / kUnit;
  }
};
static_assert(sizeof(LightEntry) == 32);

struct LightCell {
  uint32_t first;  ///< its first entry; its entries end where the next cell's begin
  float nearest;   ///< `nearest` of the first entry; infinite if there is none
  float cover;     ///< what lies deeper is in shadow: a triangle covers the cell, or a sheet without an end in it
  uint32_t first_other : 31;  ///< its first triangle in `others`
  uint32_t single : 1;        ///< down to `cover` one sheet lies over the cell and covers it once
};

/// A triangle over a cell that matters only to queries from inside something: it faces the light, or lies deeper than
/// the cell's cover.
struct LightOther {
  float nearest;  ///< a lower bound of its depth over the cell; ascends in a cell
  uint32_t triangle;
  bool operator==(const LightOther&) const = default;
  bool operator<(const LightOther& other) const {
    return nearest != other.nearest ? nearest < other.nearest : triangle < other.triangle;
  }
};

/// What a light sees of a scene; only data, see build_light_buffer. Refers to scene and sheets, which must
/// outlive it.
struct LightBuffer {
  const Scene* scene = nullptr;
  std::span<const int8_t> sides;  ///< see Sheets
  dvec3 toward{0, 1, 0};          ///< unit, to the light
  dvec3 x_axis{1, 0, 0}, y_axis{0, 0, 1};
  dvec3 center{0};  ///< scene space; subtracted first, to keep digits far from the origin

  dvec2 corner{0};  ///< where the grid begins: light space, relative to `center`
  double cells_per_unit = 1;
  double depth_per_unit = 1;  ///< depths are scaled so that the scene lies in [-1, 1]
  int cells_x = 0, cells_y = 0;

  std::vector<LightCell> cells;  ///< rows of cells_x, and one more cell that ends the last
  UninitializedVector<LightEntry> entries;
  UninitializedVector<LightOther> others;
};

/// `toward` must be unit. The same buffer for any number of threads.
LightBuffer build_light_buffer(const Scene& scene, const Sheets& sheets, const dvec3& toward, ThreadPool& pool);

/// A shadow ray toward the light. `origin` lies in scene space, offset from its surface on the side that the ray
/// leaves; `triangle` is the one that it leaves (or kNoTriangle), which faces the light there.
struct ShadowQuery {
  dvec3 origin{0};
  uint32_t triangle = kNoTriangle;
  bool from_front = true;   ///< it leaves on the triangle's counterclockwise side
  bool anywhere = false;    ///< the origin may lie inside a closed body other than the triangle's own
  bool is_precise = false;  ///< the origin is a point of the triangle, up to double precision
};

/// 1 where something lies between the origin and the light, else 0. The answer is exactly that of a ray traced in
/// double precision against every triangle but its own (intersect_triangle, is_hole): what single precision cannot
/// decide is decided by that same test, and so is every triangle with holes. One exception: for an origin inside a
/// closed body whose query does not say so (`anywhere`), as where a pixel's triangle is in fact hidden, that body's lit
/// half is not tested. Thread-safe.
void shadow_answers(const LightBuffer& buffer, std::span<const ShadowQuery> queries, std::span<uint8_t> occluded);

/// What a query's cell alone says about its answer, without its triangles.
enum class CellAnswer : uint8_t {
  lit,      ///< nothing over the cell is nearer to the light, except the sheet that the query leaves
  shadow,   ///< a triangle or sheet nearer to the light covers the whole cell
  unknown,  ///< shadow_answers() must be asked
  inside,   ///< the same; the query may start inside a closed body
};
void answers_of_cells(const LightBuffer& buffer, std::span<const ShadowQuery> queries, std::span<CellAnswer> answers);

/// True if a point seen from `eye` may lie inside a closed body: queries that start at what `eye` sees must then set
/// `anywhere`.
bool may_be_enclosed(const LightBuffer& buffer, const dvec3& eye);

/// Bytes of a finished buffer.
size_t memory_bytes(const LightBuffer& buffer);

}  // namespace hybridrt
