// Pass 5 against the same formula written out in double on the CPU.

#include "core/passes_gl/shade.h"
#include "core/procedural/spheres.h"
#include "core/trace/surface_at.h"
#include "shaders/shared.h"
#include "tests/gl/pass_test.h"

namespace hybridrt {
namespace {

constexpr int kWidth_px = 211, kHeight_px = 133;
constexpr size_t kMostLights = HRT_MAX_LIGHTS;
// Single precision on both triangles and normals; a highlight of exponent 64 multiplies the error of its
// cosine.
constexpr double kBound = 2e-4, kMeanBound = 2e-6;

class ShadePassTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (IsSkipped()) return;
    Random random(3);
    for (Material& material : scene_.materials) {
      material.kd = random.in_cube(0, 1);
      material.ks = random.in_cube(0, 1);
      material.ke = random.in_cube(0, 0.2f);
      material.ns = random.between(1, 64);
      material.opacity = random.unit();
    }
    for (size_t i = 0; i < kMostLights * kWidth_px * kHeight_px; ++i)
      lit_.push_back(random.below(2) ? HRT_MASK_LIT : 0);
    for (size_t i = 0; i < kWidth_px * kHeight_px; ++i) {
      traced_.push_back(vec4(random.in_cube(0, 3), 0));
    }
  }

  dvec3 expected(size_t pixel, uint32_t triangle, bool use_mask, bool use_traced) const {
    const dvec3 dir = view_.pixel_dir(static_cast<int>(pixel % kWidth_px), static_cast<int>(pixel / kWidth_px));
    const dvec3 weights = clamped_barycentrics(dvec3(scene_.vertex(triangle, 0)) - view_.eye,
                                               dvec3(scene_.vertex(triangle, 1)) - view_.eye,
                                               dvec3(scene_.vertex(triangle, 2)) - view_.eye, dir);
    const Surface<double> surface = surface_at(scene_, triangle, weights.y, weights.z, dir);
    const Material& m = scene_.material_of(triangle);
    dvec3 color = dvec3(m.ke) + double(m.opacity) * dvec3(ambient_) * dvec3(m.kd);
    for (size_t l = 0; l < lights_.size(); ++l) {
      // "A surface seen from its unlit side is in shadow."
      const dvec3 toward = lights_[l].toward;
      const bool masked = use_mask && lights_[l].casts_shadow;
      const bool lit =
          glm::dot(surface.side, toward) > 0 && !(masked && !(lit_[l * kWidth_px * kHeight_px + pixel] & HRT_MASK_LIT));
      const double cosine = glm::dot(surface.normal, toward);
      if (!lit || cosine <= 0) continue;
      const dvec3 halfway = glm::normalize(toward + glm::normalize(-dir));
      color += dvec3(lights_[l].color) *
               (double(m.opacity) * cosine * dvec3(m.kd) +
                std::pow(std::max(glm::dot(surface.normal, halfway), 0.0), double(m.ns)) * dvec3(m.ks));
    }
    return use_traced ? color + dvec3(traced_[pixel]) : color;
  }

  void expect_formula(bool use_mask, bool use_traced) {
    const SeenScene seen(context(), scene_, view_, 1e-5);
    const gl::TextureArray mask(gl(), GL_R8UI, kWidth_px, kHeight_px, kMostLights, "mask");
    const gl::Texture traced(gl(), GL_RGBA32F, kWidth_px, kHeight_px, "traced"),
        picture(gl(), GL_RGBA32F, kWidth_px, kHeight_px, "picture");
    write_layers(gl(), mask, kWidth_px, kHeight_px, GL_RED_INTEGER, GL_UNSIGNED_BYTE, lit_);
    write_pixels(gl(), traced, kWidth_px, kHeight_px, GL_RGBA, GL_FLOAT, traced_);
    ShadePass(gl(), gl::embedded_shaders(), lights_.size())
        .run({seen.gpu, view_, seen.ids, use_mask ? &mask : nullptr, use_traced ? &traced : nullptr, lights_, ambient_,
              background_},
             {picture});
    const auto pixels = read_pixels<vec4>(gl(), picture, kWidth_px, kHeight_px, GL_RGBA, GL_FLOAT);
    const std::vector<uint32_t> ids = seen.read_ids();
    double worst = 0, sum = 0;
    size_t surfaces = 0;
    for (size_t i = 0; i < pixels.size(); ++i) {
      if (ids[i] == kNoTriangle) {
        ASSERT_EQ(pixels[i], vec4(background_, 0)) << i;
        continue;
      }
      ++surfaces;
      ASSERT_TRUE(pixels[i].a == HRT_ALPHA_UNLIT || pixels[i].a == HRT_ALPHA_LIT) << i;
      const dvec3 error = glm::abs(dvec3(pixels[i]) - expected(i, ids[i], use_mask, use_traced));
      const double largest = std::max({error.x, error.y, error.z});
      ASSERT_LE(largest, kBound) << "pixel " << i % kWidth_px << ' ' << i / kWidth_px;
      worst = std::max(worst, largest);
      sum += largest;
    }
    EXPECT_GT(surfaces, pixels.size() / 4);
    EXPECT_LT(surfaces, pixels.size());
    EXPECT_LE(sum / surfaces, kMeanBound);
    RecordProperty("worst", std::to_string(worst));
    RecordProperty("mean", std::to_string(sum / surfaces * 1e6) + "e-6");
  }

  Scene scene_ = make_spheres({2000, 30});
  View view_ = make_view(camera_at_angle(scene_, 0.8, 0.7), dvec3(0), kWidth_px, kHeight_px);
  std::vector<DirectionalLight> lights_ = {{glm::normalize(dvec3(-0.4, 1, 0.5)), vec3(0.9f, 1.0f, 1.1f)}};
  vec3 ambient_{0.1f, 0.15f, 0.2f}, background_{0.7f, 0.6f, 0.5f};
  std::vector<uint8_t> lit_;
  std::vector<vec4> traced_;
};

TEST_F(ShadePassTest, WithoutShadowsOrRays) { expect_formula(false, false); }
TEST_F(ShadePassTest, WithAMask) { expect_formula(true, false); }
TEST_F(ShadePassTest, WithTracedLight) { expect_formula(false, true); }
TEST_F(ShadePassTest, WithAll) { expect_formula(true, true); }

// Surfaces that face away from the light show only their own and ambient light.
TEST_F(ShadePassTest, LightFromBelow) {
  lights_[0].toward = glm::normalize(dvec3(0.1, -1, 0.2));
  expect_formula(true, false);
}

TEST_F(ShadePassTest, WithoutLights) {
  lights_.clear();
  expect_formula(false, true);
}

// Each with its own layer of the mask, except one that casts no shadow.
TEST_F(ShadePassTest, UpToTheMostLights) {
  Random random(9);
  while (lights_.size() < kMostLights) {
    lights_.push_back({dvec3(glm::normalize(random.direction())), random.in_cube(0, 0.3f), lights_.size() != 2});
    if (lights_.size() == 2 || lights_.size() == 3 || lights_.size() == kMostLights) expect_formula(true, true);
  }
}

}  // namespace
}  // namespace hybridrt
