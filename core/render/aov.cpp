#include "core/render/aov.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/trace/surface_at.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

/// Calls body(index of the pixel in the source, x, y) for the kept pixels, row by row.
template <typename Body>
void for_each_kept(const View& view, const PixelRect& kept, const Body& body) {
  for (int y = kept.y_px; y < kept.y_px + kept.height_px; ++y)
    for (int x = kept.x_px; x < kept.x_px + kept.width_px; ++x) body(static_cast<size_t>(y) * view.width_px + x, x, y);
}

/// Gives neighbouring numbers unlike colours (the finaliser of MurmurHash3).
vec3 hashed_color(uint32_t h) {
  h ^= h >> 16;
  h *= 0x85ebca6bu;
  h ^= h >> 13;
  h *= 0xc2b2ae35u;
  h ^= h >> 16;
  return vec3(0.15f) + 0.85f / 255 * vec3(h & 255, (h >> 8) & 255, (h >> 16) & 255);
}

/// The share of the lights that arrive at pixel `i`; 0 where nothing is known.
float arriving_share(const AovSource& source, size_t i) {
  const std::span<const uint8_t> masks = source.lit.empty() ? source.mask : source.lit;
  if (masks.empty()) return 0;
  const size_t pixel_count = masks.size() / source.lights.size();
  const bool any_casts = count_shadow_casters(source.lights) > 0;
  int lights = 0, arriving = 0;
  for (size_t l = 0; l < source.lights.size(); ++l) {
    if (any_casts && !source.lights[l].casts_shadow) continue;
    ++lights;
    arriving += (masks[l * pixel_count + i] & HRT_MASK_LIT) != 0;
  }
  return static_cast<float>(arriving) / static_cast<float>(lights);
}

Surface<double> surface_of(const Scene& scene, const View& view, uint32_t triangle, int x, int y) {
  const dvec3 dir = view.pixel_dir(x, y);
  const dvec3 weights =
      clamped_barycentrics(dvec3(scene.vertex(triangle, 0)) - view.eye, dvec3(scene.vertex(triangle, 1)) - view.eye,
                           dvec3(scene.vertex(triangle, 2)) - view.eye, dir);
  return surface_at(scene, triangle, weights.y, weights.z, dir);
}

}  // namespace

std::vector<ImageLayer> make_aovs(const Scene& scene, const View& view, const PixelRect& kept, const AovSource& source,
                                  uint32_t aovs) {
  const auto id = [&](size_t i) { return source.ids.empty() ? kNoTriangle : source.ids[i]; };
  const size_t pixel_count = static_cast<size_t>(view.width_px) * view.height_px;
  std::vector<ImageLayer> layers;
  // One value per pixel, or three.
  const auto add_values = [&](const char* name, const char* channel, const auto& value_of) {
    ImageLayer& layer = layers.emplace_back(ImageLayer{name, {channel}, {}, {}});
    for_each_kept(view, kept, [&](size_t i, int x, int y) { layer.values.push_back(value_of(i, x, y)); });
  };
  const auto add_vectors = [&](const char* name, std::vector<std::string> channels, const auto& vector_of) {
    ImageLayer& layer = layers.emplace_back(ImageLayer{name, std::move(channels), {}, {}});
    for_each_kept(view, kept, [&](size_t i, int x, int y) {
      const vec3 v = vector_of(i, x, y);
      layer.values.insert(layer.values.end(), &v.x, &v.x + 3);
    });
  };

  if (aovs & kAovId) {
    ImageLayer& layer = layers.emplace_back(ImageLayer{"id", {"id"}, {}, {}});
    for_each_kept(view, kept, [&](size_t i, int, int) { layer.numbers.push_back(id(i)); });
  }
  if (aovs & kAovShadow) add_values("shadow", "shadow", [&](size_t i, int, int) { return arriving_share(source, i); });
  if (aovs & kAovMarked)
    add_values("marked", "marked", [&](size_t i, int, int) {
      unsigned bits = 0;
      for (size_t at = i; at < source.mask.size(); at += pixel_count)
        if (source.lights[at / pixel_count].casts_shadow) bits |= source.mask[at];
      if (bits & HRT_MASK_REPAIRED) return float{kMarkedRepaired};
      if (!(bits & HRT_MASK_MARKED)) return float{kNotMarked};
      return bits & HRT_MASK_INSIDE ? float{kMarkedInside} : float{kMarkedBoundary};
    });
  if (aovs & kAovTraced)
    add_vectors("traced", {"traced.R", "traced.G", "traced.B"},
                [&](size_t i, int, int) { return source.traced.empty() ? vec3(0) : vec3(source.traced[i]); });
  if (aovs & kAovDepth)
    add_values("depth", "Z", [&](size_t i, int x, int y) {
      if (id(i) == kNoTriangle) return kDepthOfNothing;
      return static_cast<float>(glm::dot(surface_of(scene, view, id(i), x, y).point - view.eye, view.forward));
    });
  if (aovs & kAovNormal)
    add_vectors("normal", {"N.X", "N.Y", "N.Z"}, [&](size_t i, int x, int y) {
      return id(i) == kNoTriangle ? vec3(0) : vec3(surface_of(scene, view, id(i), x, y).normal);
    });
  return layers;
}

constexpr vec3 kMarkColors[] = {vec3(0), vec3(1), vec3(1, 0, 0), vec3(1, 1, 0)};  // by MarkReason

Image display_image(const ImageLayer& aov, int width_px, int height_px) {
  Image image(width_px, height_px, 3);
  const size_t pixels = image.pixel_count(), channels = aov.channels.size();
  HRT_CHECK_EQ(aov.values.size() + aov.numbers.size(), pixels * channels);
  const bool is_depth = aov.name == "depth";
  float farthest = 0;
  for (float value : aov.values)
    if (is_depth && value < kDepthOfNothing) farthest = std::max(farthest, value);
  const float scale = farthest > 0 ? 1 / farthest : 1;
  for (size_t i = 0; i < pixels; ++i) {
    vec3 color(0);
    if (!aov.numbers.empty()) {
      if (aov.numbers[i] != kNoTriangle) color = hashed_color(aov.numbers[i]);
    } else if (aov.name == "marked") {
      color = kMarkColors[static_cast<int>(aov.values[i])];
    } else if (channels == 1) {
      color = vec3(is_depth && aov.values[i] >= kDepthOfNothing ? 0 : scale * aov.values[i]);
    } else {
      color = vec3(aov.values[3 * i], aov.values[3 * i + 1], aov.values[3 * i + 2]);
      if (aov.name == "normal" && color != vec3(0)) color = vec3(0.5f) + 0.5f * color;
    }
    std::copy(&color.x, &color.x + 3, &image.data[3 * i]);
  }
  return image;
}

}  // namespace hybridrt
