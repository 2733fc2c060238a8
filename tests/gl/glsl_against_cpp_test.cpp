// shaders/surface.glsl and shadow_warp.glsl on the GPU and as C++ must mean the same: thousands of random inputs
// through both.

#include <algorithm>
#include <random>

#include "core/gl/program.h"
#include "core/passes/shadow_warp.h"
#include "core/trace/surface.h"
#include "tests/gl/gl_test.h"

namespace hybridrt {
namespace {

constexpr int kCases = 8192, kWidth_px = 128;

struct Random {
  std::mt19937 engine{2005};
  float unit() { return static_cast<float>(engine() >> 8) * 0x1p-24f; }
  vec3 color() { return {unit(), unit(), unit()}; }
  vec3 in_cube(float half) { return half * (2.0f * color() - 1.0f); }
  vec3 direction() {
    for (;;)
      if (const vec3 v = in_cube(1); glm::dot(v, v) > 0.01f && glm::dot(v, v) < 1) return glm::normalize(v);
  }
};

class GlslAgainstCpp : public GlTest {
 protected:
  /// Runs `body`, which sets `vec4 result` from `vec4 input_at(i)`, once per case; `inputs` holds `per_case` texels per
  /// case.
  std::vector<vec4> run_glsl(const std::string& body, const std::vector<vec4>& inputs, int per_case) {
    gl::ShaderSources sources = gl::embedded_shaders();
    sources["test.comp"] =
        "#version 450 core\n#define Real float\n#define Vec2 vec2\n#define Vec3 vec3\n#define HRT_FN\n"
        "#define HRT_CHOOSE(condition, a, b) ((condition) ? (a) : (b))\n"
        "#include \"surface.glsl\"\n#include \"shadow_warp.glsl\"\n"
        "layout(local_size_x = 8, local_size_y = 8) in;\n"
        "layout(binding = 0) uniform samplerBuffer inputs;\n"
        "layout(binding = 0, rgba32f) uniform writeonly image2D outputs;\n"
        "int first_texel;\n"
        "vec4 input_at(int i) { return texelFetch(inputs, first_texel + i); }\n"
        "void main() {\n"
        "  ivec2 place = ivec2(gl_GlobalInvocationID.xy);\n"
        "  first_texel = (place.y * " +
        std::to_string(kWidth_px) + " + place.x) * " + std::to_string(per_case) +
        ";\n"
        "  vec4 result;\n" +
        body + "  imageStore(outputs, place, result);\n}\n";
    const gl::Program program(gl(), sources, {"test.comp"});
    const gl::Buffer buffer(gl(), inputs.size() * sizeof(vec4), inputs.data(), 0, "inputs");
    const gl::BufferTexture texels(gl(), buffer, GL_RGBA32F, "inputs");
    const int height = kCases / kWidth_px;
    const gl::Texture outputs(gl(), GL_RGBA32F, kWidth_px, height, "outputs");
    gl().BindTextureUnit(0, texels.id());
    gl().BindImageTexture(0, outputs.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    program.use();
    gl().DispatchCompute(kWidth_px / 8, height / 8, 1);
    return read_pixels<vec4>(gl(), outputs, kWidth_px, height, GL_RGBA, GL_FLOAT);
  }
};

float largest_difference(const vec3& a, const vec3& b) {
  const vec3 d = glm::abs(a - b);
  return std::max({d.x, d.y, d.z});
}

struct PhongCase {
  vec3 kd, ks, ke, normal, to_eye, to_light, ambient, light;
  float ns, opacity;
};

vec3 color_of(const PhongCase& c, const vec3& to_light) {
  return phong_unlit(c.kd, c.ke, c.opacity, c.ambient) +
         phong_light(c.kd, c.ks, c.ns, c.opacity, c.normal, c.to_eye, to_light, c.light);
}

PhongCase random_phong(Random& random, int i) {
  PhongCase c{random.color(),     random.color(),     random.color(),
              random.direction(), random.direction(), random.direction(),
              random.color(),     random.color(),     0,
              random.unit()};
  c.ns = i % 8 == 0 ? 0 : std::exp2(10 * random.unit());                         // up to 1024
  if (i % 7 == 0) c.to_light = -c.normal;                                        // from behind
  if (i % 11 == 0) c.to_light = -c.to_eye;                                       // no half vector
  if (i % 13 == 0) c.to_light = glm::normalize(glm::cross(c.normal, c.to_eye));  // at the horizon
  return c;
}

// The GPU's pow is good to about 2^-22 of the exponent's product; everything else to a few roundings.
TEST_F(GlslAgainstCpp, Phong) {
  Random random;
  std::vector<PhongCase> cases;
  std::vector<vec4> inputs;
  for (int i = 0; i < kCases; ++i) {
    const PhongCase c = cases.emplace_back(random_phong(random, i));
    for (const vec4& texel : {vec4(c.kd, c.ns), vec4(c.ks, c.opacity), vec4(c.ke, 0), vec4(c.normal, 0),
                              vec4(c.to_eye, 0), vec4(c.to_light, 0), vec4(c.ambient, 0), vec4(c.light, 0)})
      inputs.push_back(texel);
  }
  const std::vector<vec4> colors = run_glsl(
      "  result = vec4(phong_unlit(input_at(0).rgb, input_at(2).rgb, input_at(1).a, input_at(6).rgb) +\n"
      "                phong_light(input_at(0).rgb, input_at(1).rgb, input_at(0).a, input_at(1).a, input_at(3).xyz,\n"
      "                            input_at(4).xyz, input_at(5).xyz, input_at(7).rgb), 1.0);\n",
      inputs, 8);
  float worst = 0;
  for (int i = 0; i < kCases; ++i) {
    const PhongCase& c = cases[i];
    const vec3 expected = color_of(c, c.to_light);
    // At the horizon the highlight begins with a jump, and rounding decides on which side of it a case falls.
    const float bound = 2e-6f + 2e-6f * c.ns;
    float error = largest_difference(vec3(colors[i]), expected);
    if (std::abs(glm::dot(c.normal, c.to_light)) < 1e-6f)
      for (float nudge : {-2e-6f, 2e-6f})
        error = std::min(error, largest_difference(vec3(colors[i]), color_of(c, c.to_light + nudge * c.normal)));
    EXPECT_LE(error, bound) << "case " << i << " ns " << c.ns;
    worst = std::max(worst, error / bound);
  }
  RecordProperty("worst_share_of_bound", std::to_string(worst));
}

float smallest(const vec3& v) { return std::min({v.x, v.y, v.z}); }

struct Corner {
  vec3 p0, p1, p2, dir;
};

TEST_F(GlslAgainstCpp, ClampedBarycentrics) {
  Random random;
  std::vector<Corner> cases;
  std::vector<vec4> inputs;
  for (int i = 0; i < kCases; ++i) {
    const vec3 center = random.in_cube(10);
    const float size = std::exp2(6 * random.unit() - 3);
    Corner c{center + random.in_cube(size), center + random.in_cube(size), center + random.in_cube(size), vec3(0)};
    c.dir = center + random.in_cube(size);
    if (i % 16 == 0) c.p2 = c.p1;  // no area: seen edge-on from everywhere
    cases.push_back(c);
    for (const vec3& v : {c.p0, c.p1, c.p2, c.dir}) inputs.push_back(vec4(v, 0));
  }
  const std::vector<vec4> weights = run_glsl(
      "  result = vec4(clamped_barycentrics(input_at(0).xyz, input_at(1).xyz, input_at(2).xyz,\n"
      "                                     input_at(3).xyz), 1.0);\n",
      inputs, 4);
  double worst = 0;
  int inside = 0;
  for (int i = 0; i < kCases; ++i) {
    const Corner& c = cases[i];
    const vec3 expected = clamped_barycentrics(c.p0, c.p1, c.p2, c.dir);
    const vec3 actual(weights[i]);
    inside += smallest(expected) > 0;
    // Always weights of a point in the triangle, however it is seen.
    for (const vec3& w : {expected, actual}) {
      EXPECT_NEAR(w.x + w.y + w.z, 1, 1e-6f) << i;
      EXPECT_GE(smallest(w), -1e-6f) << i;
    }
    // The determinant is a difference of products: both lose what cancels in it.
    const dvec3 e1 = c.p1 - c.p0, e2 = c.p2 - c.p0;
    const double determinant = std::abs(glm::dot(e1, glm::cross(dvec3(c.dir), e2)));
    const double scale =
        glm::length(dvec3(c.dir)) * glm::length(e1) * glm::length(e2) +
        glm::length(dvec3(c.dir)) * glm::length(dvec3(c.p0)) * std::max(glm::length(e1), glm::length(e2));
    const double bound = determinant > 0 ? 16 * 0x1p-24 * scale / determinant : 0;
    if (bound == 0 || bound > 0.01) continue;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(actual[k], expected[k], bound + 1e-7) << i;
      worst = std::max(worst, std::abs(double(actual[k]) - expected[k]) / (bound + 1e-7));
    }
  }
  EXPECT_GT(inside, kCases / 20) << "too few cases meet their triangle";
  RecordProperty("worst_share_of_bound", std::to_string(worst));
}

TEST_F(GlslAgainstCpp, ShadowWarp) {
  Random random;
  std::vector<vec4> inputs;
  for (int i = 0; i < kCases; ++i) {
    const float slope = i % 8 == 0 ? 0 : -1 + std::exp2(-10 * random.unit());  // (-1, 0]: w up to 1000
    const vec2 texel(random.unit(), random.unit());
    inputs.push_back({random.unit(), slope, texel.x, texel.y});
    inputs.push_back({random.in_cube(100), random.in_cube(4).x});
  }
  const std::vector<vec4> results = run_glsl(
      "  float w = map_w(input_at(0).x, input_at(0).y);\n"
      "  vec2 texel = texel_size(input_at(0).z, input_at(0).w, w);\n"
      "  result = vec4(w, texel, depth_over_texel(input_at(1).xy, texel, input_at(1).w));\n",
      inputs, 2);
  for (int i = 0; i < kCases; ++i) {
    const vec4 a = inputs[2 * i], b = inputs[2 * i + 1];
    const float w = shadow_warp_single::map_w(a.x, a.y);
    const vec2 texel = shadow_warp_single::texel_size(a.z, a.w, w);
    // 1 + slope * row cancels: the effect of its rounding on w, and on its square.
    const float relative = 0x1p-22f * w;
    EXPECT_NEAR(results[i].x, w, relative * w) << i;
    EXPECT_NEAR(results[i].y, texel.x, 2 * relative * texel.x) << i;
    EXPECT_NEAR(results[i].z, texel.y, 3 * relative * texel.y) << i;
    const float most = std::abs(b.x) * texel.x + (std::abs(b.y) + std::abs(b.w * b.x)) * texel.y;
    EXPECT_NEAR(results[i].w, shadow_warp_single::depth_over_texel(vec2(b), texel, b.w), 4 * relative * most) << i;
  }
}

}  // namespace
}  // namespace hybridrt
