// `--shadows exact` through GL against the double-precision reference: no wrong shadow, and hardly a wrong triangle.

#include "core/trace/triangle.h"
#include "tests/gl/frame_test.h"

namespace hybridrt {
namespace {

const ImageLayer& layer(const Frame& frame, std::string_view name) {
  for (const ImageLayer& aov : frame.aovs)
    if (aov.name == name) return aov;
  throw std::logic_error("no such layer");
}

/// From above, grazing, along the view, and from behind.
std::vector<dvec3> lights(const Camera& camera) {
  const dvec3 view = glm::normalize(camera.eye_world - camera.target_world);
  return {{0.5, 1, 0.4}, {0, 1, 0}, {1, 0.009, 0.2}, view, glm::normalize(dvec3(-view.x, 0.3, -view.z))};
}

class ExactShadows : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    std::string why;
    if (!has_context({}, &why)) GTEST_SKIP() << why;
  }
};

TEST_P(ExactShadows, AreThoseOfTheReference) {
  RenderJob job = orbit_job(GetParam(), 1, 512, 384);
  job.settings.aovs = kAovId | kAovShadow | kAovMarked;
  int64_t receivers = 0, wrong_shadows = 0, wrong_triangles = 0, marked = 0;
  for (const dvec3& toward : lights(camera_at(job.motion, 1))) {
    job.lights.lights[0].toward = glm::normalize(toward);
    job.settings.method = Method::hybrid;
    job.settings.shadows = ShadowMode::exact;
    const Frame exact = std::move(render_all(job).front());
    job.settings.method = Method::reference;
    job.settings.shadows = ShadowMode::rays;
    const Frame truth = std::move(render_all(job).front());
    const auto &ids = layer(exact, "id").numbers, &true_ids = layer(truth, "id").numbers;
    const auto &lit = layer(exact, "shadow").values, &true_lit = layer(truth, "shadow").values;
    for (size_t i = 0; i < ids.size(); ++i) {
      receivers += true_ids[i] != kNoTriangle;
      marked += layer(exact, "marked").values[i] != 0;
      if (ids[i] == true_ids[i])
        wrong_shadows += lit[i] != true_lit[i];
      else
        ++wrong_triangles;
    }
  }
  EXPECT_EQ(wrong_shadows, 0);
  EXPECT_EQ(wrong_triangles, 0) << "of " << receivers;
  EXPECT_GT(receivers, 150000);
  EXPECT_LT(marked, receivers) << "pass 3 answered nothing";
  EXPECT_GT(marked, 0) << "pass 4 was never asked";
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExactShadows,
                         testing::Values("scene:chess,triangles=60000", "scene:thin,triangles=60000",
                                         "scene:spheres,triangles=60000"),
                         [](const auto& scene) {
                           const std::string name = scene.param;
                           return name.substr(6, name.find(',') - 6);
                         });

}  // namespace
}  // namespace hybridrt
