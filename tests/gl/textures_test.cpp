// shaders/texture.glsl on the GPU and as C++ must mean the same, and textured pictures must match those of rays.

#include <cmath>

#include "core/gl/uniform.h"
#include "core/passes_gl/scene_gpu.h"
#include "core/trace/texture_lookup.h"
#include "tests/gl/frame_test.h"
#include "tests/gl/gl_test.h"
#include "tests/support/textured_scenes.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {
namespace {

class TexturesOnTheGpu : public GlTest {
 protected:
  static constexpr int kWidth_px = 128, kHeight_px = 64, kCases = kWidth_px * kHeight_px;

  /// Colour and, as alpha, whether there is a hole, at (x, y) for a footprint of z in each case.
  std::vector<vec4> look_up(const Scene& scene, uint32_t record, uint32_t maps, const std::vector<vec4>& cases) {
    gl::ShaderSources sources = gl::embedded_shaders();
    sources["test.comp"] =
        "#version 450 core\n#define Real float\n#define Vec2 vec2\n#define Vec3 vec3\n#define HRT_FN\n"
        "#define HRT_CHOOSE(condition, a, b) ((condition) ? (a) : (b))\n"
        "#include \"texture_words.glsl\"\n#include \"texture_holes.glsl\"\n"
        "layout(local_size_x = 8, local_size_y = 8) in;\n"
        "layout(binding = 0) uniform samplerBuffer cases;\n"
        "layout(binding = 0, rgba32f) uniform writeonly image2D outputs;\n"
        "uniform int record;\nuniform int maps;\n"
        "void main() {\n"
        "  ivec2 place = ivec2(gl_GlobalInvocationID.xy);\n"
        "  vec4 at = texelFetch(cases, place.y * 128 + place.x);\n"
        "  vec3 color = texture_color(uint(record), at.xy, at.z);\n"
        "  imageStore(outputs, place, vec4(color, has_hole(uint(maps), at.xy) ? 1.0 : 0.0));\n}\n";
    const gl::Program program(gl(), sources, {"test.comp"});
    const TexturesGpu textures(context(), *scene.textures);
    const gl::Buffer buffer(gl(), cases.size() * sizeof(vec4), cases.data(), 0, "cases");
    const gl::BufferTexture texels(gl(), buffer, GL_RGBA32F, "cases");
    const gl::Texture outputs(gl(), GL_RGBA32F, kWidth_px, kHeight_px, "outputs");
    textures.bind(gl());
    gl().BindTextureUnit(0, texels.id());
    gl().BindImageTexture(0, outputs.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    program.use();
    gl::Uniform<int>(program, "record").set(static_cast<int>(record));
    gl::Uniform<int>(program, "maps").set(static_cast<int>(maps));
    gl().DispatchCompute(kWidth_px / 8, kHeight_px / 8, 1);
    return read_pixels<vec4>(gl(), outputs, kWidth_px, kHeight_px, GL_RGBA, GL_FLOAT);
  }
};

TEST_F(TexturesOnTheGpu, AreFilteredAsInCpp) {
  TextureMap odd;
  odd.clamped = true, odd.scale = {3, -0.7f}, odd.offset = {0.2f, 0.4f}, odd.base = 0.1f, odd.gain = 0.8f;
  // The leaf's words end in the middle of a row of the texture that holds them, the big one's take many rows.
  TexelImage big{300, 200, false, {}};
  Random random(7);
  for (int i = 0; i < 300 * 200; ++i) big.texels.push_back(random.engine() | 0xFF000000u);
  const std::pair<TexelImage, TextureMap> textures[] = {
      {pattern_named("noise", 100, 1000), {}}, {pattern_named("leaf", 100, 2000), odd}, {big, {}}};
  for (const auto& [image, map] : textures) {
    const Scene scene = textured_triangle(image, map);
    const uint32_t maps = scene.textures->triangle_maps[0], record = scene.textures->words[maps];
    std::vector<vec4> cases;
    for (int i = 0; i < kCases; ++i)
      cases.emplace_back(random.between(-2, 3), random.between(-2, 3), std::exp2(random.between(-16, 4)), 0);
    const std::vector<vec4> found = look_up(scene, record, maps, cases);
    TextureLookup<float> lookup{scene.textures->words.data()};
    float worst = 0;
    int other_holes = 0, holes = 0;
    for (int i = 0; i < kCases; ++i) {
      const vec3 difference = glm::abs(lookup.texture_color(record, vec2(cases[i]), cases[i].z) - vec3(found[i]));
      worst = std::max({worst, difference.x, difference.y, difference.z});
      const bool hole = lookup.has_hole(maps, vec2(cases[i]));
      holes += hole;
      other_holes += hole != (found[i].w != 0);
    }
    // log2 may differ by a few roundings, places in the image by one of 3 * 300 texels.
    EXPECT_LT(worst, 1e-4f) << image.width_px;
    EXPECT_LE(other_holes, kCases / 1000);
    if (image.has_alpha) {
      EXPECT_GT(holes, 30) << "clamped: most cases are at its edge";
    }
    RecordProperty("worst_" + std::to_string(image.width_px), std::to_string(worst));
  }
}

std::vector<Frame> render_with(RenderJob job, Method method, ShadowMode shadows) {
  job.settings.method = method;
  job.settings.shadows = shadows;
  return render_all(job);
}

/// The share of the pixels that differ by more than a step of 8 bits.
double share_of_other_pixels(const Image& a, const Image& b, float step = 1.0f / 255) {
  size_t others = 0;
  for (size_t i = 0; i < a.pixel_count(); ++i) {
    bool same = true;
    for (int c = 0; c < 3; ++c) same = same && std::abs(a.data[3 * i + c] - b.data[3 * i + c]) <= step;
    others += !same;
  }
  return static_cast<double>(others) / static_cast<double>(a.pixel_count());
}

RenderJob room_job(int frames) {
  RenderJob job = orbit_job(textured_room(), frames, 320, 240);
  job.settings.accel = Accel::kdtree;
  return job;
}

// Each method filters textures over a sample's part of the pixel.
TEST_F(TexturesOnTheGpu, SamplesAreFilteredAlike) {
  RenderJob job = room_job(1);
  job.settings.width_px = 60, job.settings.height_px = 45;  // many texels per pixel
  job.settings.samples = 4;
  const auto hybrid = render_with(job, Method::hybrid, ShadowMode::exact),
             reference = render_with(job, Method::reference, ShadowMode::rays);
  EXPECT_LT(share_of_other_pixels(hybrid[0].picture, reference[0].picture), 0.01);
}

// Edges of triangles and of holes may fall on either side of a pixel's centre; the rest is the same.
TEST_F(TexturesOnTheGpu, HybridIsTheRaytracedPicture) {
  const RenderJob job = room_job(3);
  const auto traced = render_with(job, Method::raytrace, ShadowMode::rays);
  const auto reference = render_with(job, Method::reference, ShadowMode::rays);
  for (const ShadowMode shadows : {ShadowMode::rays, ShadowMode::exact}) {
    const auto hybrid = render_with(job, Method::hybrid, shadows);
    for (size_t i = 0; i < hybrid.size(); ++i) {
      EXPECT_LT(share_of_other_pixels(hybrid[i].picture, traced[i].picture), 0.001) << "frame " << i + 1;
      EXPECT_LT(share_of_other_pixels(hybrid[i].picture, reference[i].picture), 0.0003) << "frame " << i + 1;
    }
  }
}

TEST_F(TexturesOnTheGpu, TexturesAndHolesShowAndCastShadows) {
  RenderJob job = room_job(1);
  job.settings.reflection_depth = 0;
  const Frame with = render_with(job, Method::hybrid, ShadowMode::rays)[0];
  RenderJob plain = room_job(1);
  plain.settings.reflection_depth = 0;
  plain.scene.textures = nullptr;
  for (Material& m : plain.scene.materials) m.texture_maps = 0;
  const Frame without = render_with(plain, Method::hybrid, ShadowMode::rays)[0];
  EXPECT_GT(share_of_other_pixels(with.picture, without.picture, 0.05f), 0.2);

  // The shadow map has the holes too: it differs from rays only by its coarseness at edges.
  job.settings.shadow_map_px = 2048;
  const Frame mapped = render_with(job, Method::hybrid, ShadowMode::map)[0];
  RecordProperty("map", std::to_string(share_of_other_pixels(with.picture, mapped.picture)));
  EXPECT_LT(share_of_other_pixels(with.picture, mapped.picture), 0.002);
  const Frame unshadowed = render_with(job, Method::hybrid, ShadowMode::none)[0];
  EXPECT_GT(share_of_other_pixels(with.picture, unshadowed.picture), 0.02) << "the leaf shades something";
}

}  // namespace
}  // namespace hybridrt
