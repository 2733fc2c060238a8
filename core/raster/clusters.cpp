#include "core/raster/clusters.h"

#include <algorithm>
#include <bit>
#include <span>

#include "core/base/check.h"
#include "core/trace/triangle.h"

namespace hybridrt {
namespace {

/// What a median split wants to leave in a cluster: fewer than fit, so that few clusters are cut for their vertices.
constexpr size_t kWanted = 64;

/// Ranges of at most so many triangles are divided further by one thread each.
constexpr size_t kRangePerThread = 16384;

struct Item {
  vec3 center;  ///< times 3
  uint32_t triangle;
};

struct Range {
  size_t begin, end;
  size_t size() const { return end - begin; }
};

std::vector<Item> make_items(const Scene& scene, bool with_holes) {
  std::vector<Item> items;
  if (with_holes && !scene.has_holes()) return items;
  items.reserve(scene.triangle_count());
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    const vec3 a = scene.vertex(i, 0), b = scene.vertex(i, 1), c = scene.vertex(i, 2);
    if (scene.has_holes(i) == with_holes && !is_degenerate(a, b, c))
      items.push_back({a / 3.0f + b / 3.0f + c / 3.0f, i});
  }
  return items;
}

/// Divides the range at the median of its longest axis, in multiples of kWanted.
size_t split(std::vector<Item>& items, const Range& range) {
  Aabb box;
  for (size_t i = range.begin; i < range.end; ++i) box.grow(items[i].center);
  const vec3 extent = box.extent();
  const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  size_t left = range.size() / 2;
  if (range.size() > kWanted) left = std::max<size_t>(1, (left + kWanted / 2) / kWanted) * kWanted;
  if (left >= range.size()) left = range.size() / 2;
  const auto first = items.begin() + static_cast<std::ptrdiff_t>(range.begin);
  std::nth_element(first, first + static_cast<std::ptrdiff_t>(left), first + static_cast<std::ptrdiff_t>(range.size()),
                   [axis](const Item& p, const Item& q) {
                     return p.center[axis] != q.center[axis] ? p.center[axis] < q.center[axis]
                                                             : p.triangle < q.triangle;
                   });
  return range.begin + left;
}

/// Clusters of consecutive ranges.
class Builder {
 public:
  Builder(const Scene& scene, std::vector<Item>& items, bool has_holes)
      : scene_(scene), items_(items), has_holes_(has_holes) {}

  void divide(const Range& range) {
    if (range.size() == 0) return;
    if (range.size() <= static_cast<size_t>(kClusterTriangles)) {
      find_vertices(range);
      if (vertices_.size() <= static_cast<size_t>(kClusterVertices)) return add_cluster(range);
    }
    const size_t middle = split(items_, range);
    divide({range.begin, middle});
    divide({middle, range.end});
  }

  Clusters built;

 private:
  void find_vertices(const Range& range) {
    vertices_.clear();
    for (size_t i = range.begin; i < range.end; ++i)
      for (int k = 0; k < 3; ++k) vertices_.push_back(scene_.triangle_positions[items_[i].triangle][k]);
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  }

  uint32_t number_of(uint32_t vertex) const {
    return static_cast<uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), vertex) - vertices_.begin());
  }

  void add_cluster(const Range& range) {
    Aabb box;
    for (const uint32_t vertex : vertices_) box.grow(scene_.positions[vertex]);
    const vec3 center((dvec3(box.lo) + dvec3(box.hi)) * 0.5);
    const dvec3 extent = glm::max(dvec3(box.hi) - dvec3(center), dvec3(center) - dvec3(box.lo)) * (1 + 1e-6);
    const int vertices = Clusters::padded(static_cast<int>(vertices_.size()));
    const int triangles = Clusters::padded(static_cast<int>(range.size()));
    const size_t first = built.words.size();
    built.words.resize(first + 3 * vertices + 2 * triangles, 0);
    double radius = 0;
    for (size_t i = 0; i < vertices_.size(); ++i) {
      const dvec3 offset = dvec3(scene_.positions[vertices_[i]]) - dvec3(center);
      for (int k = 0; k < 3; ++k)
        built.words[first + k * vertices + i] = std::bit_cast<uint32_t>(static_cast<float>(offset[k]));
      radius = std::max(radius, glm::length(offset));
    }
    uint32_t* const corners = &built.words[first + 3 * vertices];
    for (size_t i = range.begin; i < range.end; ++i) {
      const uvec3& t = scene_.triangle_positions[items_[i].triangle];
      const size_t n = i - range.begin;
      corners[n] = number_of(t.x) | number_of(t.y) << 8 | number_of(t.z) << 16 | static_cast<uint32_t>(n) << 24;
      corners[triangles + n] = items_[i].triangle;
    }
    const float grown = static_cast<float>(radius * (1 + 1e-6));
    built.clusters.push_back({center, grown, static_cast<uint32_t>(first), static_cast<uint8_t>(vertices_.size()),
                              static_cast<uint8_t>(range.size()), has_holes_});
    for (int k = 0; k < 3; ++k) {
      built.center[k].push_back(center[k]);
      built.extent[k].push_back(static_cast<float>(extent[k]));
    }
    built.radius.push_back(grown);
  }

  const Scene& scene_;
  std::vector<Item>& items_;
  const bool has_holes_;
  std::vector<uint32_t> vertices_;  ///< of the cluster at hand, in order
};

/// The ranges that threads divide further, in order.
std::vector<Range> make_ranges(std::vector<Item>& items, ThreadPool& pool) {
  std::vector<Range> ranges{{0, items.size()}};
  while (ranges.front().size() > kRangePerThread) {
    std::vector<Range> halves(2 * ranges.size());
    pool.run(ranges.size(), [&](size_t i, int) {
      const size_t middle = split(items, ranges[i]);
      halves[2 * i] = {ranges[i].begin, middle};
      halves[2 * i + 1] = {middle, ranges[i].end};
    });
    ranges = std::move(halves);
  }
  return ranges;
}

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

void append(Clusters& to, const Clusters& more) {
  HRT_CHECK(to.words.size() + more.words.size() < 0x100000000u);
  for (Cluster cluster : more.clusters) {
    cluster.first_word += static_cast<uint32_t>(to.words.size());
    to.clusters.push_back(cluster);
  }
  append(to.words, more.words);
  for (int k = 0; k < 3; ++k) append(to.center[k], more.center[k]), append(to.extent[k], more.extent[k]);
  append(to.radius, more.radius);
}

}  // namespace

Clusters make_clusters(const Scene& scene, ThreadPool& pool) {
  Clusters all;
  for (const bool holes : {false, true}) {
    std::vector<Item> items = make_items(scene, holes);
    if (items.empty()) continue;
    const std::vector<Range> ranges = make_ranges(items, pool);
    std::vector<Clusters> parts(ranges.size());
    pool.run(ranges.size(), [&](size_t i, int) {
      Builder builder(scene, items, holes);
      builder.divide(ranges[i]);
      parts[i] = std::move(builder.built);
    });
    for (const Clusters& part : parts) append(all, part);
  }
  for (int k = 0; k < 3; ++k)
    all.center[k].resize(all.clusters.size() + kLongestVector, 0),
        all.extent[k].resize(all.clusters.size() + kLongestVector, 0);
  all.radius.resize(all.clusters.size() + kLongestVector, 0);
  return all;
}

size_t memory_bytes(const Clusters& clusters) {
  return clusters.clusters.capacity() * sizeof(Cluster) + 7 * clusters.radius.capacity() * sizeof(float) +
         clusters.words.capacity() * sizeof(uint32_t);
}

}  // namespace hybridrt
