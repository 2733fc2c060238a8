#pragma once

#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/scene.h"

namespace hybridrt {

/// Vertices of a cluster are few enough that one of their coordinates fits four vector registers, and triangles few
/// enough that three corners and a number fit 32 bits.
inline constexpr int kClusterVertices = 64, kClusterTriangles = 128;

/// Arrays end in so many unused elements that vectors may be loaded beyond their end.
inline constexpr int kLongestVector = 16;

/// What drawing a cluster reads first.
struct Cluster {
  vec3 center;           ///< scene space
  float radius;          ///< no vertex lies farther from the centre; rounded up
  uint32_t first_word;   ///< in Clusters::words
  uint8_t vertex_count;  ///< at most kClusterVertices
  uint8_t triangle_count;
  bool has_holes;  ///< all of its triangles have holes; else none has
};

/// Triangles in groups that lie close together, and whose vertices are kept relative to the group's centre: such small
/// offsets are projected precisely in single precision. Only data; filled once per scene and then read.
struct Clusters {
  std::vector<Cluster> clusters;
  std::vector<float> center[3], extent[3], radius;  ///< of each cluster: x, y, z of its box, half the box's size

  /// Per cluster one after the other, each filled up to whole vectors: x, y and z of the vertices' offsets from the
  /// centre (float bits); per triangle its corners (first | second << 8 | third << 16 | its number here << 24); per
  /// triangle its index in the scene.
  std::vector<uint32_t> words;

  static constexpr int padded(int count) { return (count + kLongestVector - 1) / kLongestVector * kLongestVector; }
  const float* offsets(const Cluster& c) const { return reinterpret_cast<const float*>(&words[c.first_word]); }
  const uint32_t* corners(const Cluster& c) const { return &words[c.first_word] + 3 * padded(c.vertex_count); }
  const uint32_t* triangles(const Cluster& c) const { return corners(c) + padded(c.triangle_count); }
};

/// Leaves out degenerate triangles, as every structure does. The same for any number of threads.
Clusters make_clusters(const Scene& scene, ThreadPool& pool);

size_t memory_bytes(const Clusters& clusters);

}  // namespace hybridrt
