// The fingerprint changes with everything that decides pixels, and with nothing else.

#include "core/render/fingerprint.h"

#include <functional>
#include <gtest/gtest.h>
#include <set>

#include "core/procedural/spheres.h"
#include "shaders/shared.h"
#include "tests/support/textured_scenes.h"

namespace hybridrt {
namespace {

const Scene& scene() {
  static const Scene made = make_spheres({300, 20});
  return made;
}

TEST(SceneFingerprint, ChangesWithEveryField) {
  const std::vector<std::pair<const char*, std::function<void(Scene&)>>> changes = {
      {"origin", [](Scene& s) { s.origin_world.y = 1; }},
      {"position", [](Scene& s) { s.positions.back().z = std::nextafter(s.positions.back().z, 9.f); }},
      {"positions", [](Scene& s) { s.positions.push_back(vec3(0)); }},
      {"normal", [](Scene& s) { s.normals.front() = -s.normals.front(); }},
      {"triangle", [](Scene& s) { std::swap(s.triangle_positions[4].x, s.triangle_positions[4].y); }},
      {"order", [](Scene& s) { std::swap(s.triangle_positions[4], s.triangle_positions[5]); }},
      {"triangle normal", [](Scene& s) { s.triangle_normals.back().z ^= 1; }},
      {"triangle material", [](Scene& s) { s.triangle_materials[7] = s.triangle_materials[7] ? 0 : 1; }},
      {"kd", [](Scene& s) { s.materials[1].kd.x += 0.001f; }},
      {"ks", [](Scene& s) { s.materials[1].ks.y += 0.001f; }},
      {"ke", [](Scene& s) { s.materials[0].ke.z += 0.001f; }},
      {"ns", [](Scene& s) { s.materials[0].ns += 1; }},
      {"ni", [](Scene& s) { s.materials[0].ni += 0.1f; }},
      {"opacity", [](Scene& s) { s.materials[0].opacity *= 0.5f; }},
      {"reflect", [](Scene& s) { s.materials[0].reflect.x += 0.1f; }},
      {"transmit", [](Scene& s) { s.materials[0].transmit.y += 0.1f; }},
      {"fresnel", [](Scene& s) { s.materials[0].fresnel = Fresnel::schlick; }}};
  std::set<uint64_t> seen = {fingerprint(scene())};
  for (const auto& [what, change] : changes) {
    Scene changed = scene();
    change(changed);
    EXPECT_TRUE(seen.insert(fingerprint(changed)).second) << what;
  }
}

TEST(SceneFingerprint, ChangesWithTextures) {
  const Scene textured = textured_triangle(pattern_named("noise", 100, 1000));
  const std::vector<std::pair<const char*, std::function<void(Textures&)>>> changes = {
      {"texel", [](Textures& t) { t.words.back() ^= 1; }},
      {"option", [](Textures& t) { t.words[t.words[t.triangle_maps[0]] + HRT_TEXTURE_FLAGS] ^= HRT_TEXTURE_CLAMPED; }},
      {"coordinate", [](Textures& t) { t.texcoords[0].x += 0.1f; }},
      {"corner", [](Textures& t) { t.triangle_texcoords[0].x = 1; }},
      {"maps", [](Textures& t) { t.triangle_maps[0] = 0; }}};
  std::set<uint64_t> seen = {fingerprint(textured)};
  for (const auto& [what, change] : changes) {
    Textures textures = *textured.textures;
    change(textures);
    Scene changed = textured;
    changed.textures = std::make_shared<const Textures>(std::move(textures));
    EXPECT_TRUE(seen.insert(fingerprint(changed)).second) << what;
  }
}

TEST(SceneFingerprint, IsAFunctionOfTheScene) {
  EXPECT_EQ(fingerprint(scene()), fingerprint(Scene(scene())));
  EXPECT_EQ(fingerprint(make_spheres({300, 20})), fingerprint(scene()));
}

TEST(SceneFingerprint, NamesDoNotCount) {
  Scene renamed = scene();
  renamed.materials[0].name = "another name";
  EXPECT_EQ(fingerprint(renamed), fingerprint(scene()));
}

TEST(FrameFingerprint, ChangesWithCameraLightAndSettings) {
  using Change = std::function<void(FrameRequest&, RenderSettings&)>;
  const std::vector<std::pair<const char*, Change>> changes = {
      {"eye", [](FrameRequest& r, RenderSettings&) { r.camera.eye_world.x = 0.1; }},
      {"target", [](FrameRequest& r, RenderSettings&) { r.camera.target_world.y = 0.1; }},
      {"up", [](FrameRequest& r, RenderSettings&) { r.camera.up.z = 0.1; }},
      {"fov", [](FrameRequest& r, RenderSettings&) { r.camera.fov_y_rad = 0.1; }},
      {"light", [](FrameRequest& r, RenderSettings&) { r.lights = {DirectionalLight{}}; }},
      {"direction", [](FrameRequest& r, RenderSettings&) { r.lights = {{dvec3(1, 0, 0)}}; }},
      {"light color",
       [](FrameRequest& r, RenderSettings&) {
         r.lights = {{dvec3(0, 1, 0), vec3(0.5f)}};
       }},
      {"two lights", [](FrameRequest& r, RenderSettings&) { r.lights.resize(2); }},
      {"second light",
       [](FrameRequest& r, RenderSettings&) {
         r.lights = {{}, {dvec3(1, 0, 0)}};
       }},
      {"their order",
       [](FrameRequest& r, RenderSettings&) {
         r.lights = {{dvec3(1, 0, 0)}, {}};
       }},
      {"width", [](FrameRequest&, RenderSettings& s) { s.width_px = 100; }},
      {"height", [](FrameRequest&, RenderSettings& s) { s.height_px = 100; }},
      {"method", [](FrameRequest&, RenderSettings& s) { s.method = Method::reference; }},
      {"shadows", [](FrameRequest&, RenderSettings& s) { s.shadows = ShadowMode::rays; }},
      {"kernel", [](FrameRequest&, RenderSettings& s) { s.blur_kernel_px = 7; }},
      {"ambient", [](FrameRequest&, RenderSettings& s) { s.ambient.color.x = 0.5f; }},
      {"ambient slope", [](FrameRequest&, RenderSettings& s) { s.ambient.slope.y = 0.5f; }},
      {"alpha", [](FrameRequest&, RenderSettings& s) { s.alpha = true; }},
      {"background", [](FrameRequest&, RenderSettings& s) { s.background.z = 0.5f; }},
      {"map", [](FrameRequest&, RenderSettings& s) { s.shadow_map_px = 512; }},
      {"warp", [](FrameRequest&, RenderSettings& s) { s.shadow_warp = ShadowWarp::uniform; }},
      {"shadowless light",
       [](FrameRequest& r, RenderSettings&) {
         r.lights = {{dvec3(0, 1, 0), vec3(1), false}};
       }},
      {"depth", [](FrameRequest&, RenderSettings& s) { s.reflection_depth = 1; }}};
  std::set<uint64_t> seen = {fingerprint(1, FrameRequest{}, RenderSettings{})};
  EXPECT_TRUE(seen.insert(fingerprint(2, FrameRequest{}, RenderSettings{})).second) << "scene";
  for (const auto& [what, change] : changes) {
    FrameRequest request;
    RenderSettings settings;
    change(request, settings);
    EXPECT_TRUE(seen.insert(fingerprint(1, request, settings)).second) << what;
  }
}

TEST(FrameFingerprint, DoesNotKnowHowFramesAreMade) {
  RenderSettings settings;
  const uint64_t before = fingerprint(1, FrameRequest{}, settings);
  settings.frames_in_flight = 1;
  settings.aovs = kAovId;
  EXPECT_EQ(fingerprint(1, FrameRequest{}, settings), before);
}

}  // namespace
}  // namespace hybridrt
