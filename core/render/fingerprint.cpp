#include "core/render/fingerprint.h"

#include <cstring>
#include <span>

namespace hybridrt {
namespace {

/// Hashes bytes eight at a time; the mixing step is MurmurHash3's finaliser.
struct Hasher {
  uint64_t state;

  void word(uint64_t w) {
    state ^= w;
    state ^= state >> 33;
    state *= 0xff51afd7ed558ccdull;
    state ^= state >> 33;
    state *= 0xc4ceb9fe1a85ec53ull;
    state ^= state >> 33;
  }

  template <typename T>
  void values(std::span<const T> array) {
    const char* bytes = reinterpret_cast<const char*>(array.data());
    size_t size = array.size_bytes();
    word(size);
    for (; size >= 8; size -= 8, bytes += 8) {
      uint64_t w;
      std::memcpy(&w, bytes, 8);
      word(w);
    }
    uint64_t rest = 0;
    if (size > 0) std::memcpy(&rest, bytes, size);  // an empty array has no address
    word(rest);
  }

  void value(double x) {
    uint64_t w;
    std::memcpy(&w, &x, 8);
    word(w);
  }
  template <typename V>
  void vector(const V& v) {
    for (int i = 0; i < 3; ++i) value(v[i]);
  }
};

}  // namespace

uint64_t fingerprint(const Scene& scene) {
  Hasher hash{0x687962726964ull};
  hash.vector(scene.origin_world);
  hash.values(std::span(scene.positions));
  hash.values(std::span(scene.normals));
  hash.values(std::span(scene.triangle_positions));
  hash.values(std::span(scene.triangle_normals));
  hash.values(std::span(scene.triangle_materials));
  for (const Material& m : scene.materials) {
    for (const vec3& color : {m.kd, m.ks, m.ke, m.reflect, m.transmit}) hash.vector(color);
    for (double x : {static_cast<double>(m.ns), static_cast<double>(m.ni), static_cast<double>(m.opacity)})
      hash.value(x);
    hash.word(static_cast<uint64_t>(m.fresnel));
  }
  if (scene.has_colors()) {
    hash.values(std::span(scene.colors));
    hash.values(std::span(scene.triangle_colors));
  }
  if (scene.textures) {
    hash.values(std::span(scene.textures->words));
    hash.values(std::span(scene.textures->texcoords));
    hash.values(std::span(scene.textures->triangle_texcoords));
    hash.values(std::span(scene.textures->triangle_maps));
  }
  return hash.state;
}

uint64_t fingerprint(const gl::ShaderSources& shaders) {
  Hasher hash{0x676c736c};
  for (const auto& [name, text] : shaders) {
    hash.values(std::span(name));
    hash.values(std::span(text));
  }
  return hash.state;
}

uint64_t fingerprint(uint64_t scene, const FrameRequest& request, const RenderSettings& s) {
  Hasher hash{scene};
  const Camera& c = request.camera;
  for (const dvec3& v : {c.eye_world, c.target_world, c.up}) hash.vector(v);
  hash.value(c.fov_y_rad);
  hash.word(request.lights.size());
  for (const DirectionalLight& light : request.lights) {
    hash.vector(light.toward);
    hash.vector(light.color);
    hash.word(light.casts_shadow);
  }
  for (const vec3& color : {s.ambient.color, s.ambient.slope, s.background}) hash.vector(color);
  for (int x : {s.width_px, s.height_px, static_cast<int>(s.method), static_cast<int>(s.shadows), s.blur_kernel_px,
                s.shadow_map_px, static_cast<int>(s.shadow_warp), static_cast<int>(s.forms), s.reflection_depth,
                s.samples, static_cast<int>(takes_edge_samples(s)), static_cast<int>(s.alpha)})
    hash.word(static_cast<uint64_t>(x));
  const PixelRect picture = picture_rect(s);
  for (int x : {picture.x_px, picture.y_px, picture.width_px, picture.height_px}) hash.word(static_cast<uint64_t>(x));
  return hash.state;
}

}  // namespace hybridrt
