#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/view.h"
#include "core/trace/light_buffer.h"

namespace hybridrt {

/// A light and what answers its shadow rays.
struct TracedLight {
  DirectionalLight light;
  const LightBuffer* buffer = nullptr;  ///< null: the light casts no shadow, or its shadow rays are traced
};

/// What the CPU tracer needs to know of a frame. Refers to scene, view and light buffers, which must outlive it.
struct TraceJob {
  const Scene& scene;
  const View& view;
  std::vector<TracedLight> lights;  ///< at most HRT_MAX_LIGHTS (shaders/shared.h); all that cast shadows have buffers,
                                    ///< or none has
  bool shadows = true;              ///< shadow rays at the hits of reflected and refracted rays
  int reflection_depth = 4;         ///< generations after the primary one
  AmbientLight ambient{};           ///< times Kd
  vec3 background{0.7f};            ///< the colour of rays that meet nothing

  bool eye_enclosed = false;  ///< see may_be_enclosed

  /// Whether buffers answer the shadow rays; else they are traced like any other.
  bool has_buffers() const {
    return std::any_of(lights.begin(), lights.end(), [](const TracedLight& traced) { return traced.buffer; });
  }
  bool casts_shadow(size_t light) const { return shadows && lights[light].light.casts_shadow; }
};

/// What pass 4 did. Rays are counted when they are fired; a pixel counts as marked once per light that it asks.
struct TraceStats {
  int64_t pixels_hit = 0, pixels_marked = 0, pixels_reflective = 0, pixels_refractive = 0;
  int64_t shadow_rays = 0;          ///< all generations
  int64_t primary_shadow_rays = 0;  ///< those of the primary generation
  int64_t reflection_rays = 0, refraction_rays = 0;
  double shadow_cpu_ms = 0;     ///< thread time of the primary generation's shadow rays
  double secondary_cpu_ms = 0;  ///< thread time of everything after the primary generation

  int64_t pixels_suspect = 0, pixels_repaired = 0;  ///< see RepairStats
  double repair_ms = 0;                             ///< wall time of that

  int64_t pixels_resampled = 0;  ///< those near edges, which have all samples (sample_edges)

  int64_t pixels_lit = 0;  ///< those of pixels_hit at which some light arrives

  void add(const TraceStats& other);
};

}  // namespace hybridrt
