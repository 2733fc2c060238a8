#include "core/load/off_columns.h"

#include <algorithm>

namespace hybridrt {
namespace {

constexpr size_t kMostLookedAt = 10000;  // vertices

/// How well the numbers go with an order of columns.
struct Fit {
  bool possible = true;  // every colour is one of 0 to 255, or of 0 to 1
  size_t unit_normals = 0;
};

Fit fit_of(const OffColumns& columns, const OffExtras& extras) {
  Fit fit;
  const size_t vertices = std::min(kMostLookedAt, extras.numbers.size() / extras.per_vertex);
  for (size_t i = 0; i < vertices; ++i) {
    const double* row = extras.numbers.data() + i * extras.per_vertex;
    for (size_t c = columns.color; c < columns.color + columns.color_count; ++c)
      fit.possible &= !(row[c] < 0 || row[c] > 255 || (row[c] > 1 && row[c] != std::floor(row[c])));
    const double* n = row + columns.normal;
    fit.unit_normals += std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 0.02;
  }
  return fit;
}

}  // namespace

OffColumns find_columns(const OffHeader& header, const OffExtras& extras) {
  const size_t normal_count = header.normals ? 3 : 0, texture_count = header.texture ? 2 : 0;
  OffColumns normals_first;
  normals_first.has_normals = header.normals;
  normals_first.color = normal_count;
  normals_first.color_count = extras.per_vertex - std::min(extras.per_vertex, normal_count + texture_count);
  if (!(header.normals && header.colors) || normals_first.color_count == 0) return normals_first;

  OffColumns colors_first = normals_first;
  colors_first.color = 0;
  colors_first.normal = colors_first.color_count;
  const Fit a = fit_of(normals_first, extras), b = fit_of(colors_first, extras);
  if (a.possible != b.possible) return a.possible ? normals_first : colors_first;
  return a.unit_normals > b.unit_normals ? normals_first : colors_first;
}

}  // namespace hybridrt
