#include "core/trace/trace_job.h"

namespace hybridrt {

void TraceStats::add(const TraceStats& other) {
  pixels_hit += other.pixels_hit;
  pixels_resampled += other.pixels_resampled;
  pixels_lit += other.pixels_lit;
  pixels_marked += other.pixels_marked;
  pixels_reflective += other.pixels_reflective;
  pixels_refractive += other.pixels_refractive;
  shadow_rays += other.shadow_rays;
  primary_shadow_rays += other.primary_shadow_rays;
  reflection_rays += other.reflection_rays;
  refraction_rays += other.refraction_rays;
  pixels_suspect += other.pixels_suspect;
  pixels_repaired += other.pixels_repaired;
  repair_ms += other.repair_ms;
  shadow_cpu_ms += other.shadow_cpu_ms;
  secondary_cpu_ms += other.secondary_cpu_ms;
}

}  // namespace hybridrt
