#include "core/trace/coincident.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/trace/holes.h"
#include "core/trace/triangle.h"

namespace hybridrt {
namespace {

using Corners = std::array<vec3, 3>;

Corners corners_of(const Scene& scene, uint32_t triangle) {
  Corners corners;
  for (int k = 0; k < 3; ++k) corners[k] = scene.vertex(triangle, k) + vec3(0);  // -0 becomes +0
  return corners;
}

uint64_t hash_of(const vec3& v) {
  uint64_t h = std::bit_cast<uint32_t>(v.x) * 0x9E3779B97F4A7C15u;
  h = (h ^ h >> 29 ^ std::bit_cast<uint32_t>(v.y)) * 0xBF58476D1CE4E5B9u;
  h = (h ^ h >> 32 ^ std::bit_cast<uint32_t>(v.z)) * 0x94D049BB133111EBu;
  return h ^ h >> 31;
}

/// The same for any order of the corners.
uint64_t hash_of(const Scene& scene, uint32_t triangle) {
  const Corners c = corners_of(scene, triangle);
  return hash_of(c[0]) + hash_of(c[1]) + hash_of(c[2]);
}

bool is_less(const vec3& a, const vec3& b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

/// A triangle that may have others on it.
struct Candidate {
  uint64_t hash;
  uint32_t triangle;
  Corners sorted;
  bool turned;  ///< its corners, from the lowest on, do not ascend
};

Candidate candidate_of(const Scene& scene, uint32_t triangle, uint64_t hash) {
  const Corners c = corners_of(scene, triangle);
  const auto lowest = std::min_element(c.begin(), c.end(), is_less) - c.begin();
  const vec3 second = c[(lowest + 1) % 3], third = c[(lowest + 2) % 3];
  const bool turned = is_less(third, second);
  return {hash, triangle, {c[lowest], turned ? third : second, turned ? second : third}, turned};
}

bool precedes(const Candidate& a, const Candidate& b) {
  if (a.hash != b.hash) return a.hash < b.hash;
  for (int k = 0; k < 3; ++k)
    if (a.sorted[k] != b.sorted[k]) return is_less(a.sorted[k], b.sorted[k]);
  return a.triangle < b.triangle;
}

/// A bit for each of many values of a hash: most triangles are alone, which one look each tells.
class HashBits {
 public:
  explicit HashBits(size_t triangles) : bits_(std::bit_ceil(triangles / 2 + 8)) {}
  /// Whether it was set before.
  bool set(uint64_t hash) {
    uint32_t& word = bits_[hash >> 5 & (bits_.size() - 1)];
    const uint32_t bit = 1u << (hash & 31), before = word;
    word |= bit;
    return before & bit;
  }
  bool holds(uint64_t hash) const { return bits_[hash >> 5 & (bits_.size() - 1)] >> (hash & 31) & 1; }

 private:
  std::vector<uint32_t> bits_;
};

std::vector<Candidate> find_candidates(const Scene& scene) {
  const auto count = static_cast<uint32_t>(scene.triangle_count());
  HashBits met(count), met_twice(count);
  for (uint32_t i = 0; i < count; ++i)
    if (const uint64_t hash = hash_of(scene, i); met.set(hash)) met_twice.set(hash);
  std::vector<Candidate> candidates;
  for (uint32_t i = 0; i < count; ++i) {
    const uint64_t hash = hash_of(scene, i);
    if (!met_twice.holds(hash) || is_degenerate(scene.vertex(i, 0), scene.vertex(i, 1), scene.vertex(i, 2))) continue;
    candidates.push_back(candidate_of(scene, i, hash));
  }
  std::sort(candidates.begin(), candidates.end(), precedes);
  return candidates;
}

/// `group`: triangles with the same corners, ascending.
void link(const Scene& scene, std::span<const Candidate> group, CoincidentTriangles& found) {
  bool is_covered[2] = {false, false};  // by winding
  std::vector<uint32_t> shown;
  for (const Candidate& candidate : group) {
    (is_covered[candidate.turned] ? found.hidden : shown).push_back(candidate.triangle);
    is_covered[candidate.turned] |= !(scene.has_holes() && scene.has_holes(candidate.triangle));
  }
  if (shown.size() < 2) return;
  if (found.tied_of.empty()) found.tied_of.resize(scene.triangle_count(), CoincidentTriangles::kAlone);
  const auto first = static_cast<uint32_t>(found.tied.size());
  for (uint32_t i = 0; i < shown.size(); ++i) {
    const uint32_t next = i + 1 < shown.size() ? first + i + 1 : first;
    found.tied_of[shown[i]] = first + i;
    found.tied.push_back({shown[i], corners_of(scene, shown[i]), next});
  }
}

}  // namespace

CoincidentTriangles find_coincident(const Scene& scene) {
  CoincidentTriangles found;
  const std::vector<Candidate> candidates = find_candidates(scene);
  for (size_t first = 0, last; first < candidates.size(); first = last) {
    for (last = first + 1; last < candidates.size() && candidates[last].sorted == candidates[first].sorted;) ++last;
    if (last - first > 1) link(scene, std::span(candidates).subspan(first, last - first), found);
  }
  std::sort(found.hidden.begin(), found.hidden.end());
  return found;
}

TriangleAt winner_of_tie(const CoincidentTriangles& coincident, const Textures* holes, const TriangleAt& met,
                         const vec3& dir) {
  if (coincident.tied_of.empty()) return met;
  const uint32_t place = coincident.tied_of[met.triangle];
  if (place == CoincidentTriangles::kAlone) return met;
  const CoincidentTriangles::Tied& own = coincident.tied[place];
  const auto meets_front = [&](const Corners& c) {
    const dvec3 a(c[0]), b(c[1]), d(c[2]);
    return glm::dot(glm::cross(b - a, d - a), dvec3(dir)) < 0;
  };
  // The weight of a corner, wherever another triangle has it.
  const auto weight_of = [&](const vec3& corner) {
    return corner == own.corners[1] ? met.u : corner == own.corners[2] ? met.v : 1 - met.u - met.v;
  };
  TriangleAt best = met;
  bool best_from_front = meets_front(own.corners);
  for (uint32_t i = own.next; i != place; i = coincident.tied[i].next) {
    const CoincidentTriangles::Tied& other = coincident.tied[i];
    const bool from_front = meets_front(other.corners);
    const bool wins = from_front != best_from_front ? from_front : other.triangle < best.triangle;
    const TriangleAt at{other.triangle, weight_of(other.corners[1]), weight_of(other.corners[2])};
    if (!wins || (holes && is_hole(*holes, at.triangle, at.u, at.v))) continue;
    best = at, best_from_front = from_front;
  }
  return best;
}

}  // namespace hybridrt
