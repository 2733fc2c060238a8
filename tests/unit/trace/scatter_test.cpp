// Reflection and refraction: directions, weights and Fresnel's equations.

#include "core/trace/scatter.h"

#include <gtest/gtest.h>

#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

template <typename Real>
constexpr Real kTolerance = std::is_same_v<Real, float> ? Real(4e-6) : Real(1e-13);

Material glass(float ni) {
  Material m;
  m.transmit = vec3(1);
  m.ni = ni;
  m.fresnel = Fresnel::dielectric;
  return m;
}

template <typename Real>
Surface<Real> floor_surface(bool from_outside = true) {
  Surface<Real> s;
  s.side = s.normal = Vec3<Real>(0, 1, 0);
  s.from_outside = from_outside;
  return s;
}

/// A direction that comes down at an angle to the normal.
template <typename Real>
Vec3<Real> coming_at(double sine) {
  return Vec3<Real>(dvec3(sine, -std::sqrt(1 - sine * sine), 0));
}

template <typename Rays>
bool finite(const Rays& s) {
  return all_finite(dvec3(s.reflected_dir)) && all_finite(dvec3(s.refracted_dir)) &&
         all_finite(dvec3(s.reflected_weight)) && all_finite(dvec3(s.refracted_weight));
}

template <typename Real>
class Scatter : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Scatter, Reals);

TYPED_TEST(Scatter, GlassLosesNoLight) {
  using Real = TypeParam;
  for (float ni : {1.01f, 1.33f, 1.5f, 2.4f, 0.7f})
    for (bool outside : {true, false})
      for (int i = 0; i <= 1000; ++i) {
        const auto s = scatter(glass(ni), floor_surface<Real>(outside), coming_at<Real>(i / 1000.0));
        ASSERT_TRUE(finite(s)) << ni << ' ' << i;
        ASSERT_NEAR(s.reflected_weight.x + s.refracted_weight.x, 1, kTolerance<Real>) << ni << ' ' << i;
        ASSERT_GE(s.reflected_weight.x, 0);
        ASSERT_LE(s.reflected_weight.x, 1 + kTolerance<Real>);
      }
}

TYPED_TEST(Scatter, SnellsLaw) {
  using Real = TypeParam;
  for (bool outside : {true, false}) {
    const double eta = outside ? 1 / 1.5 : 1.5;
    for (double sine : {0.0, 0.2, 0.4, 0.6}) {
      const auto s = scatter(glass(1.5f), floor_surface<Real>(outside), coming_at<Real>(sine));
      EXPECT_NEAR(s.refracted_dir.x, eta * sine, kTolerance<Real>);
      EXPECT_LT(s.refracted_dir.y, 0) << "it goes through";
      EXPECT_NEAR(glm::length(s.refracted_dir), 1, kTolerance<Real>);
      EXPECT_NEAR(s.reflected_dir.x, sine, kTolerance<Real>);
      EXPECT_NEAR(s.reflected_dir.y, std::sqrt(1 - sine * sine), kTolerance<Real>);
    }
  }
}

// Known on paper: ((n - 1) / (n + 1))^2 straight on, all of it at a grazing angle, none of the light that
// swings in the plane of incidence at Brewster's angle.
TYPED_TEST(Scatter, FresnelsEquations) {
  using Real = TypeParam;
  EXPECT_NEAR(fresnel_dielectric(Real(1), Real(1), Real(1) / Real(1.5)), 0.04, kTolerance<Real>);
  EXPECT_NEAR(fresnel_dielectric(Real(1), Real(1), Real(1.5)), 0.04, kTolerance<Real>);
  EXPECT_NEAR(fresnel_dielectric(Real(0), Real(0.5), Real(1) / Real(1.5)), 1, kTolerance<Real>);
  const double brewster = std::atan(1.5), cos_in = std::cos(brewster), cos_out = std::sin(brewster);
  const double perpendicular = (cos_in / 1.5 - cos_out) / (cos_in / 1.5 + cos_out);
  EXPECT_NEAR(fresnel_dielectric(Real(cos_in), Real(cos_out), Real(1 / 1.5)), 0.5 * perpendicular * perpendicular,
              kTolerance<Real>);
}

TYPED_TEST(Scatter, TotalInternalReflection) {
  using Real = TypeParam;
  const auto s = scatter(glass(1.5f), floor_surface<Real>(false), coming_at<Real>(0.8));
  EXPECT_EQ(s.reflected_weight, Vec3<Real>(1));
  EXPECT_EQ(s.refracted_weight, Vec3<Real>(0));
}

TYPED_TEST(Scatter, NoJumpAndNoNanAtTheCriticalAngle) {
  using Real = TypeParam;
  const double critical = 1 / 1.5;
  for (double step : {-1e-6, -1e-7, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-7, 1e-6}) {
    const auto s = scatter(glass(1.5f), floor_surface<Real>(false), coming_at<Real>(critical + step));
    EXPECT_TRUE(finite(s)) << step;
    EXPECT_NEAR(s.reflected_weight.x + s.refracted_weight.x, 1, kTolerance<Real>) << step;
    EXPECT_GT(s.reflected_weight.x, 0.98) << step;  // 1 - R falls as the square root of the distance
  }
}

TYPED_TEST(Scatter, ReflectionsNeverDiveUnderTheSurface) {
  using Real = TypeParam;
  Random random(9);
  Material mirror;
  mirror.reflect = vec3(1);
  for (int i = 0; i < 20000; ++i) {
    Surface<Real> s;
    const auto unit = [&] { return glm::normalize(Vec3<Real>(random.direction())); };
    const Vec3<Real> dir = unit();
    s.side = turned_toward(unit(), -dir);
    s.normal = turned_toward(unit(), s.side);
    s.from_outside = i % 2;
    for (const Material& material : {mirror, glass(1.5f)}) {
      const auto out = scatter(material, s, dir);
      ASSERT_TRUE(finite(out)) << i;
      ASSERT_GE(glm::dot(out.reflected_dir, s.side), -kTolerance<Real>) << i;
      ASSERT_NEAR(glm::length(out.reflected_dir), 1, 4 * kTolerance<Real>) << i;
      if (out.refracted_weight != Vec3<Real>(0)) {
        ASSERT_LE(glm::dot(out.refracted_dir, s.side), kTolerance<Real>) << i;
      }
    }
  }
}

// Between 0 and 90 degrees in fine steps toward the ends, where cosines vanish.
TYPED_TEST(Scatter, FresnelHoldsUpToGrazingAngles) {
  using Real = TypeParam;
  for (bool outside : {true, false})
    for (double from_grazing : {0.0, 1e-16, 1e-12, 1e-8, 1e-6, 1e-4, 1e-2}) {
      const auto s = scatter(glass(1.5f), floor_surface<Real>(outside), coming_at<Real>(1 - from_grazing));
      ASSERT_TRUE(finite(s)) << from_grazing;
      EXPECT_NEAR(s.reflected_weight.x + s.refracted_weight.x, 1, kTolerance<Real>) << from_grazing;
      EXPECT_GT(s.reflected_weight.x, from_grazing < 1e-7 ? 0.99 : 0.4) << from_grazing;
    }
}

// Tf colours what passes, once per surface; what is reflected keeps its colour, inside too.
TYPED_TEST(Scatter, TfFiltersWhatPassesAndNothingElse) {
  using Real = TypeParam;
  Material green = glass(1.5f);
  green.transmit = vec3(0.25f, 0.75f, 0.5f);
  for (bool outside : {true, false}) {
    const auto s = scatter(green, floor_surface<Real>(outside), coming_at<Real>(0));
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(s.reflected_weight[k], 0.04, kTolerance<Real>);
      EXPECT_NEAR(s.refracted_weight[k], 0.96 * green.transmit[k], kTolerance<Real>);
    }
  }
  const auto total = scatter(green, floor_surface<Real>(false), coming_at<Real>(0.9));
  EXPECT_EQ(total.reflected_weight, Vec3<Real>(1));
}

// A new ray starts off its surface, by the whole offset however flat it leaves, and yet lies on the line through the
// surface's point: an offset to the side would be magnified by every curved mirror that it meets.
TYPED_TEST(Scatter, RaysLeaveOnTheirLine) {
  using Real = TypeParam;
  Random random(11);
  int steep = 0;
  for (int i = 0; i < 20000; ++i) {
    Surface<Real> s;
    s.side = glm::normalize(Vec3<Real>(random.direction()));
    s.offset = Real(0.01);
    Vec3<Real> dir = turned_toward(glm::normalize(Vec3<Real>(random.direction())), s.side);
    const bool toward = i % 2;
    if (!toward) dir = -dir;
    const Vec3<Real> origin = leave(s, dir, toward).origin, side = toward ? s.side : -s.side;
    ASSERT_NEAR(glm::dot(origin, side), s.offset, kTolerance<Real>) << i;
    ASSERT_LE(glm::length(origin), 4.2 * s.offset) << "not far along the ray, " << i;
    if (glm::dot(dir, side) < 0.25) continue;
    ++steep;
    ASSERT_LE(glm::length(glm::cross(origin, dir)), kTolerance<Real>) << i;
  }
  EXPECT_GT(steep, 10000);
}

TYPED_TEST(Scatter, PlainMirrorAndSchlick) {
  using Real = TypeParam;
  Material mirror;
  mirror.reflect = vec3(0.5f, 0.25f, 0);
  for (double sine : {0.0, 0.5, 0.99}) {
    const auto s = scatter(mirror, floor_surface<Real>(), coming_at<Real>(sine));
    EXPECT_EQ(s.reflected_weight, Vec3<Real>(mirror.reflect));
    EXPECT_EQ(s.refracted_weight, Vec3<Real>(0));
  }
  mirror.fresnel = Fresnel::schlick;
  EXPECT_NEAR(scatter(mirror, floor_surface<Real>(), coming_at<Real>(0)).reflected_weight.x, 0.5, kTolerance<Real>);
  EXPECT_NEAR(scatter(mirror, floor_surface<Real>(), coming_at<Real>(1)).reflected_weight.z, 1, kTolerance<Real>);
  const auto half = scatter(mirror, floor_surface<Real>(), coming_at<Real>(std::sqrt(0.75)));  // cosine 0.5
  EXPECT_NEAR(half.reflected_weight.z, std::pow(0.5, 5), kTolerance<Real>);
}

TYPED_TEST(Scatter, ClearSurfacesLetLightStraightOn) {
  using Real = TypeParam;
  Material veil;
  veil.transmit = vec3(0.3f);
  const auto s = scatter(veil, floor_surface<Real>(), coming_at<Real>(0.6));
  EXPECT_EQ(s.refracted_dir, coming_at<Real>(0.6));
  EXPECT_EQ(s.refracted_weight, Vec3<Real>(vec3(0.3f)));
  EXPECT_EQ(s.reflected_weight, Vec3<Real>(0));
}

}  // namespace
}  // namespace hybridrt
