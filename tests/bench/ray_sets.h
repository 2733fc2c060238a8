#pragma once

#include <string>
#include <vector>

#include "core/scene/view.h"
#include "core/trace/light_buffer.h"
#include "core/trace/ray_caster.h"

namespace hybridrt {

/// A scene and its view.
struct BenchScene {
  Scene scene;
  View view;        ///< 1024x768
  dvec3 toward{0};  ///< unit, to the light
};

/// `argument` as for `hybridrt render`, with its textures. Procedural scenes are seen as in their pictures, others from
/// slightly above.
BenchScene load_bench_scene(const std::string& argument, ThreadPool& pool);

/// The rays that a frame fires, in the order in which it fires them: tile by tile.
struct RaySets {
  std::vector<Ray<float>> primary;
  std::vector<ShadowQuery> shadow_all;  ///< from every pixel that faces the light
  std::vector<ShadowQuery>
      shadow_marked;  ///< from those with another answer within two pixels, as the paper marks them
  std::vector<Ray<float>> reflected_flat, reflected_curved;  ///< as if everything seen were a mirror
  std::vector<Ray<float>> refracted;                         ///< into everything seen, as if it were glass (Ni 1.5)
};
RaySets make_ray_sets(const BenchScene& scene, const RayCaster<float>& caster, const LightBuffer& buffer);

/// The same queries as rays for a tracer in single precision, with its larger offset from the surface.
std::vector<Ray<float>> as_rays(const std::vector<ShadowQuery>& queries, const dvec3& toward);

}  // namespace hybridrt
