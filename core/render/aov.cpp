#include "core/render/aov.h"

#include "core/trace/surface_at.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

template <typename ColorOf>
AovImage make_image(const char* name, const View& view, const ColorOf& color_of) {
  AovImage aov{name, Image(view.width_px, view.height_px, 3)};
  for (int y = 0; y < view.height_px; ++y)
    for (int x = 0; x < view.width_px; ++x) {
      const vec3 color = color_of(static_cast<size_t>(y) * view.width_px + x, x, y);
      std::copy(&color.x, &color.x + 3, aov.image.pixel(x, y));
    }
  return aov;
}

/// Neighbouring numbers get unlike colours (the finaliser of MurmurHash3).
vec3 hashed_color(uint32_t h) {
  h ^= h >> 16;
  h *= 0x85ebca6bu;
  h ^= h >> 13;
  h *= 0xc2b2ae35u;
  h ^= h >> 16;
  return vec3(0.15f) + 0.85f / 255 * vec3(h & 255, (h >> 8) & 255, (h >> 16) & 255);
}

Surface<double> surface_of(const Scene& scene, const View& view, uint32_t triangle, int x, int y) {
  const dvec3 dir = view.pixel_dir(x, y);
  const dvec3 weights =
      clamped_barycentrics(dvec3(scene.vertex(triangle, 0)) - view.eye, dvec3(scene.vertex(triangle, 1)) - view.eye,
                           dvec3(scene.vertex(triangle, 2)) - view.eye, dir);
  return surface_at(scene, triangle, weights.y, weights.z, dir);
}

AovImage depth_image(const Scene& scene, const View& view, std::span<const uint32_t> ids) {
  float farthest = 0;
  AovImage aov = make_image("depth", view, [&](size_t i, int x, int y) {
    if (ids.empty() || ids[i] == kNoTriangle) return vec3(0);
    const double depth = glm::dot(surface_of(scene, view, ids[i], x, y).point - view.eye, view.forward);
    farthest = std::max(farthest, static_cast<float>(depth));
    return vec3(static_cast<float>(depth));
  });
  if (farthest > 0)
    for (float& value : aov.image.data) value /= farthest;
  return aov;
}

}  // namespace

std::vector<AovImage> make_aovs(const Scene& scene, const View& view, const AovSource& source, uint32_t aovs) {
  const auto id = [&](size_t i) { return source.ids.empty() ? kNoTriangle : source.ids[i]; };
  std::vector<AovImage> images;
  if (aovs & kAovId)
    images.push_back(make_image("id", view, [&](size_t i, int, int) {
      return id(i) == kNoTriangle ? vec3(0) : hashed_color(id(i));
    }));
  if (aovs & kAovShadow)
    images.push_back(make_image("shadow", view, [&](size_t i, int, int) {
      const auto mask = source.lit.empty() ? source.mask : source.lit;
      return vec3(!mask.empty() && (mask[i] & HRT_MASK_LIT) ? 1.0f : 0.0f);
    }));
  if (aovs & kAovMarked)
    images.push_back(make_image("marked", view, [&](size_t i, int, int) {
      return vec3(!source.mask.empty() && (source.mask[i] & HRT_MASK_MARKED) ? 1.0f : 0.0f);
    }));
  if (aovs & kAovTraced)
    images.push_back(make_image("traced", view, [&](size_t i, int, int) {
      return source.traced.empty() ? vec3(0) : vec3(source.traced[i]);
    }));
  if (aovs & kAovDepth) images.push_back(depth_image(scene, view, source.ids));
  if (aovs & kAovNormal)
    images.push_back(make_image("normal", view, [&](size_t i, int x, int y) {
      if (id(i) == kNoTriangle) return vec3(0);
      return vec3(0.5) + 0.5f * vec3(surface_of(scene, view, id(i), x, y).normal);
    }));
  return images;
}

}  // namespace hybridrt
