#include "tests/support/textured_scenes.h"

#include <cmath>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/load/load_textures.h"
#include "tests/support/load_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trace_scenes.h"

namespace hybridrt {

TexelImage pattern_named(const std::filesystem::path& path, int largest_side_px, uint64_t most_texels) {
  const std::string name = path.filename().string();
  if (name.starts_with("torn")) throw error(ErrorKind::input, "{}: broken image", path.string());
  TexelImage image;
  if (name.starts_with("grey")) image.damage = "it ends too early";
  Random random(17);
  const auto fill = [&](int width, int height, const auto& texel) {
    image.width_px = width, image.height_px = height;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) image.texels.push_back(texel(x, y));
  };
  if (name.starts_with("noise")) {
    fill(12, 7, [&](int, int) { return texel_of(random.below(256), random.below(256), random.below(256)); });
  } else if (name.starts_with("blank") || name.starts_with("faint")) {
    image.has_alpha = true;
    const uint32_t alpha = name.starts_with("blank") ? 0 : 100;
    fill(12, 7, [&](int, int) { return texel_of(random.below(256), random.below(256), random.below(256), alpha); });
  } else if (name.starts_with("black")) {
    fill(8, 8, [&](int, int) { return texel_of(30, 30, 30); });
  } else if (name.starts_with("leaf")) {
    image.has_alpha = true;
    fill(32, 32, [&](int x, int y) {
      const int i = x % 16 - 8, j = y % 16 - 8;
      return texel_of(40, 100 + random.below(100), 20, i * i + j * j < 30 ? 0 : 255);
    });
  } else {
    fill(8, 8, [&](int x, int y) { return (x + y) % 2 ? texel_of(30, 30, 30) : texel_of(220, 220, 220); });
  }
  if (image.width_px > largest_side_px || image.texels.size() > most_texels)
    throw error(ErrorKind::input, "{}: too large", path.string());
  return image;
}

TexelFiles texel_files(TexelReader read) {
  const auto size = [read](const std::filesystem::path& path, int largest_side_px, uint64_t most_texels) {
    const TexelImage image = read(path, largest_side_px, most_texels);
    return TexelSize{image.width_px, image.height_px, 8 * image.texels.size()};
  };
  return {size, std::move(read)};
}

Scene textured_triangle(const TexelImage& image, TextureMap map) {
  Scene scene;
  add_triangle(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  map.path = "image";
  scene.materials = {Material{}};
  scene.materials[0].maps = {map};
  scene.triangle_materials = {0};
  Textures textures;
  textures.texcoords = {vec2(0, 0), vec2(1, 0), vec2(0, 1)};
  textures.triangle_texcoords = {uvec3(0, 1, 2)};
  LoadWatch watch;
  watch.textures = texel_files([&](const std::filesystem::path&, int, uint64_t) { return image; });
  ThreadPool pool(1);
  Warnings warnings;
  load_textures(scene, std::move(textures), pool, warnings, watch);
  return scene;
}

Scene with_random_holes(Scene scene, uint32_t seed) {
  scene.materials = {Material{}, Material{}};
  TextureMap leaf;
  leaf.path = "leaf.png";
  scene.materials[1].maps = {leaf};
  scene.triangle_materials.clear();
  Random random(seed);
  Textures textures;
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    scene.triangle_materials.push_back(i % 2);
    for (int corner = 0; corner < 3; ++corner)
      textures.texcoords.emplace_back(random.between(-2, 3), random.between(-2, 3));
    textures.triangle_texcoords.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  LoadWatch watch;
  watch.textures = texel_files(pattern_named);
  ThreadPool pool(1);
  Warnings warnings;
  load_textures(scene, std::move(textures), pool, warnings, watch);
  return scene;
}

namespace {

/// The name says the size; half of it are holes.
TexelImage random_holes(const std::filesystem::path& path, int, uint64_t) {
  TexelImage image;
  image.has_alpha = true;
  if (sscanf(path.filename().string().c_str(), "%dx%d", &image.width_px, &image.height_px) != 2) return image;
  Random random(17);
  static constexpr uint32_t kAlphas[] = {0, 127, 128, 255};
  for (int i = 0; i < image.width_px * image.height_px; ++i)
    image.texels.push_back(texel_of(40, 200, 20, i == 0 ? 0 : kAlphas[random.below(4)]));
  return image;
}

void load_random_holes(Scene& scene, Textures textures) {
  LoadWatch watch;
  watch.textures = texel_files(random_holes);
  ThreadPool pool(1);
  Warnings warnings;
  load_textures(scene, std::move(textures), pool, warnings, watch);
}

}  // namespace

Scene with_all_kinds_of_holes(Scene scene, uint32_t seed) {
  Random random(seed);
  scene.materials.clear();
  for (const char* size : {"1x1", "1x7", "5x1", "3x2", "64x64", "300x200"})
    for (const bool clamped : {false, true}) {
      TextureMap map;
      map.path = size, map.clamped = clamped;
      if (random.below(2)) map.scale = vec2(random.between(-3, 3), random.between(-3, 3));
      if (random.below(2)) map.offset = vec2(random.between(-9, 9), random.between(-9, 9));
      scene.materials.emplace_back().maps = {map};
    }
  scene.triangle_materials.clear();
  Textures textures;
  for (uint32_t i = 0; i < scene.triangle_count(); ++i) {
    scene.triangle_materials.push_back(random.below(static_cast<uint32_t>(scene.materials.size())));
    const float size = random.below(3) ? std::pow(10.0f, random.between(-4, 4)) : 0;
    const float from = random.below(2) ? 0 : std::pow(10.0f, random.between(-1, 15));
    const vec2 first(from * random.between(-1, 1), from * random.between(-1, 1));
    for (int corner = 0; corner < 3; ++corner)
      textures.texcoords.push_back(first + size * vec2(random.between(-1, 1), random.between(-1, 1)));
    textures.triangle_texcoords.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  load_random_holes(scene, std::move(textures));
  return scene;
}

Scene sheet_of_holes(int cells, int step, float texels_per_cell, bool clamped) {
  constexpr int kSize = 300;
  Scene scene;
  Textures textures;
  const auto add = [&](int x, int y) {
    scene.positions.emplace_back(static_cast<float>(x - cells / 2), static_cast<float>(y - cells / 2), 0);
    textures.texcoords.push_back(((vec2(x, y) + 0.5f) * texels_per_cell + vec2(kSize / 2)) / static_cast<float>(kSize));
    return static_cast<uint32_t>(scene.positions.size() - 1);
  };
  for (int x = 0; x + step <= cells; x += step)
    for (int y = 0; y + step <= cells; y += step) {
      const uint32_t a = add(x, y), b = add(x + step, y), c = add(x + step, y + step), d = add(x, y + step);
      for (const uvec3& corners : {uvec3(a, b, c), uvec3(a, c, d)}) scene.triangle_positions.push_back(corners);
    }
  textures.triangle_texcoords = scene.triangle_positions;
  TextureMap map;
  map.path = fmt::format("{0}x{0}", kSize), map.clamped = clamped;
  scene.materials = {Material{}};
  scene.materials[0].maps = {map};
  scene.triangle_materials.assign(scene.triangle_count(), 0);
  scene.bounds = compute_bounds(scene);
  load_random_holes(scene, std::move(textures));
  return scene;
}

Scene textured_room() {
  const TemporaryFolder folder;
  for (const char* name : {"noise.png", "leaf.png", "mask.png"}) folder.write(name, "x");
  folder.write("room.mtl",
               "newmtl floor\nKd 0.9 0.9 0.9\nmap_Kd -s 3 5 noise.png\nnewmtl leaf\nmap_Kd leaf.png\n"
               "newmtl mirror\nKd 0.2 0.2 0.2\nKs 0.8 0.8 0.8\nNs 50\nillum 3\nmap_Ks mask.png\n"
               "newmtl lamp\nKd 0 0 0\nKe 1 1 1\nmap_Ke -mm 0.1 0.5 -clamp on noise.png\n");
  const std::filesystem::path obj =
      folder.write("room.obj",
                   "mtllib room.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt -0.5 0\n"
                   "v -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nusemtl floor\nf 4/1 3/2 2/3 1/4\n"
                   "v -2 1 -2\nv 1 1.5 -2\nv 1 1.5 2\nv -2 1 2\nusemtl leaf\nf 8/1 7/2 6/3 5/4\n"
                   "v -3 0 -3.5\nv 3 0 -3.5\nv 3 3 -3\nv -3 3 -3\nusemtl mirror\nf 9/1 10/2 11/3 12/4\n"
                   "v 2 0.2 -1\nv 3.5 0.2 -1\nv 3.5 2 -1\nv 2 2 -1\nusemtl lamp\nf 13/5 14/2 15/3 16/4\n");
  LoadWatch watch;
  watch.textures = texel_files(pattern_named);
  ThreadPool pool(2);
  Warnings warnings;
  return load_scene(obj.string(), pool, warnings, std::nullopt, watch);
}

}  // namespace hybridrt
