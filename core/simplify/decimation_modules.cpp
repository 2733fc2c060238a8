#include "core/simplify/decimation_modules.h"

#include <algorithm>
#include <limits>

#include "core/base/check.h"
#include "core/mesh/triangle_distance.h"

namespace hybridrt::decimation {

Corner KeepCorners::corner_at(Mesh::FaceHandle face, Mesh::VertexHandle vertex) const {
  const CornerTriangle& triangle = (*triangle_of_face_)[static_cast<size_t>(face.idx())];
  return triangle.corners[corner_index_at(*fans_, triangle, static_cast<uint32_t>(vertex.idx()))];
}

void KeepCorners::preprocess_collapse(const CollapseInfo& collapse) {
  HRT_CHECK(collapse.fl.is_valid() && collapse.fr.is_valid());
  const Corner target = corner_at(collapse.fl, collapse.v1);
  HRT_CHECK(shade_alike(*scene_, target, corner_at(collapse.fr, collapse.v1)));
  for (const auto face : mesh().vf_range(collapse.v0)) {
    if (face == collapse.fl || face == collapse.fr) continue;
    CornerTriangle& triangle = (*triangle_of_face_)[static_cast<size_t>(face.idx())];
    triangle.corners[corner_index_at(*fans_, triangle, static_cast<uint32_t>(collapse.v0.idx()))] = target;
  }
}

void SampledBounds::find_moved(const CollapseInfo& collapse) {
  moved_.clear();
  gathered_.clear();
  gathered_.push_back({to_dvec3(collapse.p0), bound_of_vertex_[static_cast<size_t>(collapse.v0.idx())]});
  for (const auto face : mesh().vf_range(collapse.v0)) {
    const std::vector<Sample>& of_face = samples_[static_cast<size_t>(face.idx())];
    gathered_.insert(gathered_.end(), of_face.begin(), of_face.end());
    if (face == collapse.fl || face == collapse.fr) continue;
    Moved moved{face, {}, {}, {}};
    dvec3* const corners[3] = {&moved.a, &moved.b, &moved.c};
    int k = 0;
    for (const auto vertex : mesh().fv_range(face))
      *corners[k++] = to_dvec3(vertex == collapse.v0 ? collapse.p1 : mesh().point(vertex));
    moved_.push_back(moved);
  }
}

bool SampledBounds::keeps_bounds(const CollapseInfo& collapse) {
  find_moved(collapse);
  for (const Sample& sample : gathered_) {
    const auto is_near = [&](const Moved& at) {
      return squared_distance_to_triangle(sample.point, at.a, at.b, at.c) <= sample.bound * sample.bound;
    };
    if (std::none_of(moved_.begin(), moved_.end(), is_near)) return false;
  }
  return true;
}

float SampledBounds::collapse_priority(const CollapseInfo& collapse) {
  const float priority = quadrics_->collapse_priority(collapse);
  if (collapse.v0 != looked_at_) looked_at_ = collapse.v0, best_ = std::numeric_limits<float>::infinity();
  if (!(priority < best_) || !keeps_bounds(collapse)) return ILLEGAL_COLLAPSE;
  best_ = priority;
  return LEGAL_COLLAPSE;
}

void SampledBounds::preprocess_collapse(const CollapseInfo& collapse) {
  looked_at_.invalidate();
  find_moved(collapse);
  HRT_CHECK(!moved_.empty());
  for (const auto face : mesh().vf_range(collapse.v0)) samples_[static_cast<size_t>(face.idx())].clear();
  for (const Sample& sample : gathered_) {
    const Moved* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Moved& at : moved_) {
      const double squared = squared_distance_to_triangle(sample.point, at.a, at.b, at.c);
      if (squared < least) least = squared, nearest = &at;
    }
    HRT_CHECK(nearest);
    samples_[static_cast<size_t>(nearest->face.idx())].push_back(sample);
  }
}

}  // namespace hybridrt::decimation
