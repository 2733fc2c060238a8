#include "core/render/default_light.h"

#include "core/trace/surface.h"

namespace hybridrt {
namespace {

constexpr float kAmbient = 0.2f;
constexpr double kAmbientSlope = 0.8, kFillFromAbove = 0.6;

}  // namespace

DirectionalLight default_light(Surroundings surroundings, const Camera& camera, const AmbientLight& ambient) {
  const dvec3 up(0, 1, 0);
  dvec3 back = camera.eye_world - camera.target_world;
  back -= glm::dot(back, up) * up;
  back = glm::length(back) > 0 ? glm::normalize(back) : dvec3(0, 0, 1);
  const dvec3 left = glm::cross(back, up);

  DirectionalLight light;
  light.casts_shadow = surroundings != Surroundings::inside;
  light.toward = glm::normalize(surroundings == Surroundings::outside ? 1.2 * up + 0.7 * left + 0.6 * back
                                                                      : 0.45 * up + 0.35 * left + back);
  light.color = color_beside(ambient, light.toward);
  return light;
}

AmbientLight default_ambient(Surroundings surroundings, const dvec3& toward) {
  if (surroundings == Surroundings::inside) return {};
  const dvec3 up(0, 1, 0);
  const dvec3 fill = kFillFromAbove * up - (toward - glm::dot(toward, up) * up);
  return {vec3(kAmbient), vec3(kAmbientSlope * glm::normalize(fill))};
}

vec3 color_beside(const AmbientLight& ambient, const dvec3& toward) {
  const vec3 there = ambient_at(ambient.color, ambient.slope, vec3(toward));
  return glm::max(vec3(1) - there, vec3(0));
}

}  // namespace hybridrt
