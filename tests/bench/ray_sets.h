#pragma once

#include <string>
#include <vector>

#include "core/scene/view.h"
#include "core/trace/light_buffer.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// A scene and how it is looked at.
struct BenchScene {
  Scene scene;
  View view;        ///< 1024x768
  dvec3 toward{0};  ///< unit, to the light
};

/// `argument` as for `hybridrt render`; procedural scenes as their pictures show them, others from slightly
/// above.
BenchScene load_bench_scene(const std::string& argument, ThreadPool& pool);

/// The rays that a frame fires, in the order in which it fires them: tile by tile.
struct RaySets {
  std::vector<Ray<float>> primary;
  std::vector<ShadowQuery> shadow_all;     ///< of every pixel that faces the light
  std::vector<ShadowQuery> shadow_marked;  ///< of those with another answer within two pixels, as the paper marks them
  std::vector<Ray<float>> reflected_flat, reflected_curved;  ///< as though everything seen were a mirror
  std::vector<Ray<float>> refracted;  ///< as though everything seen were glass (Ni 1.5), entering it
};
RaySets make_ray_sets(const BenchScene& scene, const RayCaster<float>& caster, const LightBuffer& buffer);

/// The same queries as rays of a tracer in single precision, off their surface by its larger offset.
std::vector<Ray<float>> as_rays(const std::vector<ShadowQuery>& queries, const dvec3& toward);

}  // namespace hybridrt
