#include "core/passes_cpu/shadow_test.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/passes/shadow_warp.h"
#include "core/trace/surface.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

/// shaders/shadow_test.comp and what it reads of shaders/scene.glsl.
class PixelTest {
 public:
  explicit PixelTest(const ShadowTest& test)
      : test_(test),
        scene_(test.scene),
        eye_high_(test.view.eye),
        eye_low_(test.view.eye - dvec3(eye_high_)),
        ray_first_(test.view.ray_first()),
        ray_step_x_(test.view.ray_step_x()),
        ray_step_y_(test.view.ray_step_y()),
        to_light_(test.to_light),
        map_from_eye_(map_from_eye(test.fit, test.view.eye)),
        fit_(map_fit_of(test.fit)),
        size_(static_cast<float>(test.map_px)) {}

  uint8_t mask(int x, int y, uint32_t id) const {
    if (id == kNoTriangle) return HRT_MASK_NO_RECEIVER;
    const vec3 dir = ray_first_ + static_cast<float>(test_.view.x_px + x) * ray_step_x_ +
                     static_cast<float>(test_.view.y_px + y) * ray_step_y_;
    const vec3 p0 = corner(id, 0), p1 = corner(id, 1), p2 = corner(id, 2);
    const vec3 normal = turned_toward(normalized_or(glm::cross(p1 - p0, p2 - p0), -dir), -dir);
    const float cos_light = glm::dot(normal, to_light_);
    if (cos_light <= 0) return 0;  // seen from its unlit side

    const vec3 weights = clamped_barycentrics(p0, p1, p2, dir);
    const vec3 point = weights.x * p0 + weights.y * p1 + weights.z * p2;
    const vec4 in_map = map_from_eye_ * vec4(point, 1);
    const vec2 uv = vec2(in_map) / in_map.w;
    const int column = texel_of(uv.x), row = texel_of(uv.y);
    const float w = shadow_warp_single::map_w((static_cast<float>(row) + 0.5f) / size_, fit_.inverse_w_slope);
    const float nearest = test_.map[static_cast<size_t>(row) * test_.map_px + column] * w;
    return nearest < in_map.z - shadow_warp_single::depth_offset(fit_, normal, cos_light, uv.x, w) ? 0 : HRT_MASK_LIT;
  }

 private:
  vec3 corner(uint32_t id, int number) const { return (scene_.vertex(id, number) - eye_high_) - eye_low_; }
  int texel_of(float place) const { return static_cast<int>(std::max(0.0f, std::min(size_ - 1, place * size_))); }

  const ShadowTest& test_;
  const Scene& scene_;
  const vec3 eye_high_, eye_low_, ray_first_, ray_step_x_, ray_step_y_, to_light_;
  const mat4 map_from_eye_;
  const shadow_warp_single::MapFit fit_;
  const float size_;
};

}  // namespace

void test_shadows(const ShadowTest& test, ThreadPool& pool, std::span<uint8_t> mask) {
  HRT_CHECK_EQ(test.ids.size(), mask.size());
  HRT_CHECK_EQ(test.map.size(), static_cast<size_t>(test.map_px) * test.map_px);
  const PixelTest pixel(test);
  const auto width = static_cast<size_t>(test.view.width_px);
  parallel_for(pool, mask.size(), 8 * width, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      mask[i] = pixel.mask(static_cast<int>(i % width), static_cast<int>(i / width), test.ids[i]);
  });
}

}  // namespace hybridrt
