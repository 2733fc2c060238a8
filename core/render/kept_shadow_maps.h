#pragma once

#include <optional>
#include <vector>

#include "core/passes_cpu/shadow_map.h"
#include "core/raster/visibility.h"
#include "core/render/frame_plan.h"

namespace hybridrt {

/// The CPU form's shadow maps of a sequence, one per light, each kept while its light stands still; a warped one also
/// needs the camera to stand still, and is fitted to the first sample of a frame for all of them.
class KeptShadowMaps {
 public:
  struct Map {
    std::optional<LightFrame> light;  ///< the light that it was drawn for
    View view;
    ShadowMapFit fit;
    std::vector<float> depth;  ///< as draw_shadow_map() writes it
  };

  /// All must outlive it.
  KeptShadowMaps(const Scene& scene, const Clusters& clusters, const RenderSettings& settings, ThreadPool& pool)
      : scene_(scene), clusters_(clusters), settings_(settings), pool_(pool) {}
  KeptShadowMaps(const KeptShadowMaps&) = delete;
  KeptShadowMaps& operator=(const KeptShadowMaps&) = delete;

  /// Draws the maps of the plan's lights that cast shadows. `ids`: what the plan's view sees. Returns the milliseconds
  /// that it took, 0 if all were kept.
  double update(const FramePlan& plan, std::span<const uint32_t> ids);

  const Map& of(size_t light) const { return maps_[light]; }

 private:
  bool is_kept(const FramePlan& plan, size_t light) const;
  std::vector<dvec3> visible_receivers(const FramePlan& plan, std::span<const uint32_t> ids);

  const Scene& scene_;
  const Clusters& clusters_;
  const RenderSettings& settings_;
  ThreadPool& pool_;
  std::vector<Map> maps_;
  ShadowMapMemory memory_;

  // What the whole frame sees, if only a part is rendered.
  RasterMemory whole_raster_;
  std::vector<uint32_t> whole_ids_;
};

}  // namespace hybridrt
