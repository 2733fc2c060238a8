#pragma once

#include "core/render/settings.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"

namespace hybridrt {

/// What to render for a frame number.
struct FrameRequest {
  int number = 1;
  Camera camera;
  std::vector<DirectionalLight> lights;  ///< at most HRT_MAX_LIGHTS (shaders/shared.h)
  bool light_moves = false;              ///< one of them, from frame to frame
  dvec2 sample_offset_px{0};             ///< see View::sample_px
};

/// Facts about a scene that plans need; computed once.
struct SceneFacts {
  Aabb bounds;             ///< box of all triangles, scene space
  Aabb scattering_bounds;  ///< box of triangles whose material reflects or refracts; empty: there are none
};
SceneFacts make_scene_facts(const Scene& scene);

/// Whether the GL's ids are corrected.
bool repairs_ids(const RenderSettings& settings);

/// True if some frame of the scene may need rays that no light buffer answers, so that a caster must be built.
bool needs_caster(const SceneFacts& facts, const RenderSettings& settings, bool light_moves);

/// Everything about a frame that is known before it is rendered: a plain value, no GL. What a plan leaves out costs
/// nothing.
struct FramePlan {
  int number = 1;
  View view;
  double near_distance = 0;  ///< nearer surfaces are cut away by pass 2
  std::vector<DirectionalLight> lights;

  // The same for all lights that cast shadows.
  bool shadows = false;                      ///< any shadows, also in mirrors
  bool shadow_map = false;                   ///< pass 1 and the shadow test of pass 2
  bool mark_blur = false;                    ///< pass 3 as in the paper, by blurring the shadow test
  bool mark_exact = false;                   ///< pass 3 by the light buffer's cells: marks what they cannot answer
  bool repair = false;                       ///< pass 4 first corrects ids where the raster may be wrong
  bool trace_shadows = false;                ///< pass 4 decides which pixels are lit
  bool trace_scattered = false;              ///< pass 4 follows reflected and refracted rays
  bool light_buffers = false;                ///< light buffers answer all shadow rays; else they are traced
  bool read_ids = false, read_mask = false;  ///< what is read back

  bool casts_shadow(size_t light) const { return shadows && lights[light].casts_shadow; }
  bool trace() const { return trace_shadows || trace_scattered || repair; }
};

/// Pure: the same arguments give the same plan.
FramePlan make_frame_plan(const Scene& scene, const SceneFacts& facts, const FrameRequest& request,
                          const RenderSettings& settings);

/// False only when no part of the box can be seen.
bool may_be_seen(const View& view, const Aabb& box);

}  // namespace hybridrt
