#include "core/load/load_textures.h"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <tuple>

#include "core/base/error.h"
#include "core/image/mip_levels.h"
#include "core/image/srgb.h"
#include "core/load/mesh_data.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

static_assert(static_cast<uint32_t>(MapKind::diffuse) == HRT_MAP_DIFFUSE &&
              static_cast<uint32_t>(MapKind::specular) == HRT_MAP_SPECULAR &&
              static_cast<uint32_t>(MapKind::emitted) == HRT_MAP_EMITTED &&
              static_cast<uint32_t>(MapKind::holes) == HRT_MAP_HOLES);

constexpr size_t kReadTogether = 8;         // bounds the memory used besides the words
constexpr uint32_t kMostMapSets = 1 << 20;  // the GPU gets their indices as floats

/// An image as one kind of map uses it.
struct TextureImage {
  const TextureMap* map = nullptr;
  int width_px = 0, height_px = 0, levels = 1;
  std::vector<uint32_t> texels;  ///< all levels, one after the other
  bool has_holes = false;        ///< some alpha is under one half
  bool alpha_is_zero = false;    ///< in every texel of the file: it counts as opaque
  uint32_t first = 0;            ///< its index in the words
  bool missing = false;          ///< replaced by a checker, except for map_d
  std::string failure;           ///< why, unless the MTL reader has already said so
  bool usable_as(MapKind kind) const { return kind == MapKind::diffuse || !missing; }
};

using Key = std::tuple<std::string, bool, char, float, float>;

/// Two images differ if different texels are made of their files. That depends on -mm for map_d, since texels alone
/// decide where holes are.
Key key_of(const TextureMap& map) {
  const bool holes = map.kind == MapKind::holes;
  return {map.path.string(), holes, map.channel, holes ? map.base : 0, holes ? map.gain : 0};
}

uint32_t byte_of(uint32_t texel, int i) { return texel >> 8 * i & 255; }

uint32_t channel_of(uint32_t texel, char channel) {
  switch (channel) {
    case 'r': return byte_of(texel, 0);
    case 'g': return byte_of(texel, 1);
    case 'b': return byte_of(texel, 2);
    case 'm': return byte_of(texel, 3);
  }
  return (byte_of(texel, 0) + byte_of(texel, 1) + byte_of(texel, 2) + 1) / 3;
}

/// Stores each texel's opacity, as map_d gives it, in its alpha.
void make_opacity(TexelImage& image, const TextureMap& map) {
  const auto see_through = [](uint32_t texel) { return texel >> 24 != 255; };
  const bool by_alpha = std::any_of(image.texels.begin(), image.texels.end(), see_through);
  const char channel = map.channel ? map.channel : by_alpha ? 'm' : 'l';
  for (uint32_t& texel : image.texels) {
    const float opacity = map.base + map.gain * static_cast<float>(channel_of(texel, channel)) / 255;
    texel = 0xFFFFFFu | static_cast<uint32_t>(std::clamp(opacity, 0.f, 1.f) * 255 + 0.5f) << 24;
  }
}

/// A checker of eight by eight squares.
TexelImage checker() {
  constexpr int kSide_px = 64;
  TexelImage image{kSide_px, kSide_px, false, {}};
  for (int y = 0; y < kSide_px; ++y)
    for (int x = 0; x < kSide_px; ++x) image.texels.push_back((x / 8 + y / 8) % 2 ? 0xFFFF00FFu : 0xFF404040u);
  return image;
}

/// An alpha of 0 in every texel is a channel that nobody filled in.
bool drop_zero_alpha(TexelImage& image) {
  if (std::any_of(image.texels.begin(), image.texels.end(), [](uint32_t texel) { return texel >> 24 != 0; }))
    return false;
  for (uint32_t& texel : image.texels) texel |= 0xFF000000u;
  return true;
}

void prepare(TextureImage& image, TexelImage&& read) {
  const TextureMap& map = *image.map;
  image.alpha_is_zero = drop_zero_alpha(read);
  image.width_px = read.width_px, image.height_px = read.height_px;
  if (map.kind == MapKind::holes)
    make_opacity(read, map);
  else if (map.channel)
    for (uint32_t& texel : read.texels) texel = channel_of(texel, map.channel) * 0x010101u | 0xFF000000u;
  image.has_holes =
      std::any_of(read.texels.begin(), read.texels.end(), [](uint32_t texel) { return texel >> 24 < 128; });
  image.texels = std::move(read.texels);
  if (map.kind != MapKind::holes) image.levels = append_mip_levels(image.texels, 0, image.width_px, image.height_px);
}

class Loader {
 public:
  Loader(Scene& scene, Textures&& textures, ThreadPool& pool, Warnings& warnings, const LoadWatch& watch)
      : scene_(scene), textures_(std::move(textures)), pool_(pool), warnings_(warnings), watch_(watch) {}

  void run() {
    find_images();
    if (sets_ == 0) return;
    lay_out();
    read_images();
    set_materials();
    if (!any_) return;
    finish_triangles();
    scene_.textures = std::make_shared<Textures>(std::move(textures_));
  }

 private:
  void find_images() {
    used_.assign(scene_.materials.size(), false);
    for (uint32_t material : scene_.triangle_materials) used_[material] = true;
    for (size_t i = 0; i < used_.size(); ++i) {
      if (!used_[i] || scene_.materials[i].maps.empty()) continue;
      ++sets_;
      for (const TextureMap& map : scene_.materials[i].maps) {
        ++records_;
        if (!indices_.try_emplace(key_of(map), images_.size()).second) continue;
        images_.emplace_back().map = &map;
      }
    }
    if (sets_ > kMostMapSets)
      throw error(ErrorKind::input, "{}: {} materials with textures are more than the {} that can be drawn",
                  scene_.files.front(), sets_, kMostMapSets);
  }

  void lay_out() {
    for (int code = 0; code < 256; ++code)
      textures_.words.push_back(std::bit_cast<uint32_t>(static_cast<float>(linear_from_srgb(code / 255.0))));
    next_set_ = 256;
    next_record_ = next_set_ + HRT_MAP_KINDS * sets_;
    textures_.words.resize(next_record_ + size_t{HRT_TEXTURE_RECORD} * records_);
  }

  /// Reads a few at a time and takes them in order: which ones the words have no room for does not depend on the
  /// threads.
  void read_images() {
    const uint64_t most_words = std::min<uint64_t>(kMostTextureWords, watch_.most_bytes / 16);
    for (size_t begin = 0; begin < images_.size(); begin += kReadTogether) {
      const uint64_t left = most_words - std::min<uint64_t>(most_words, textures_.words.size());
      const size_t count = std::min(kReadTogether, images_.size() - begin);
      pool_.run(count, [&](size_t i, int) { read(images_[begin + i], std::min(left, kMostTexels)); });
      for (size_t i = begin; i < begin + count; ++i) take(images_[i], most_words);
    }
    if (unreadable_ > 0)
      warnings_.push_back(
          fmt::format("{} textures cannot be used: map_Kd becomes a checker, others are left out (first: {})",
                      unreadable_, first_failure_));
    if (zero_alpha_.count() > 0)
      warnings_.push_back(fmt::format("{} textures have an alpha of 0 in every texel, which was taken as opaque ({})",
                                      zero_alpha_.count(), zero_alpha_.text()));
  }

  void read(TextureImage& image, uint64_t most_texels) const {
    const TextureMap& map = *image.map;
    image.missing = map.path.empty();
    if (image.missing) return;
    try {
      prepare(image, watch_.read_texels(map.path, kLargestTextureSide_px, most_texels));
    } catch (const Error& problem) {
      image.failure = problem.what();
    }
  }

  void take(TextureImage& image, uint64_t most_words) {
    const std::string file = image.map->path.string();
    if (image.failure.empty() && textures_.words.size() + image.texels.size() > most_words)
      image.failure = fmt::format("{}: no memory is left for it among the other textures", file);
    if (!image.failure.empty()) {
      image.missing = true;
      if (unreadable_++ == 0) first_failure_ = image.failure;
    }
    if (image.alpha_is_zero) zero_alpha_.add(image.map->path.filename().string());
    if (image.missing) {
      if (image.map->kind == MapKind::holes) return;
      prepare(image, checker());
    } else if (std::find(scene_.files.begin(), scene_.files.end(), file) == scene_.files.end()) {
      scene_.files.push_back(file);
    }
    image.first = static_cast<uint32_t>(textures_.words.size());
    textures_.words.insert(textures_.words.end(), image.texels.begin(), image.texels.end());
    image.texels = {};
  }

  uint32_t add_record(const TextureImage& image, const TextureMap& map) {
    uint32_t* const words = &textures_.words[next_record_];
    const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
    words[HRT_TEXTURE_WIDTH] = static_cast<uint32_t>(image.width_px);
    words[HRT_TEXTURE_HEIGHT] = static_cast<uint32_t>(image.height_px);
    words[HRT_TEXTURE_LEVELS] = static_cast<uint32_t>(image.levels);
    words[HRT_TEXTURE_FIRST] = image.first;
    words[HRT_TEXTURE_FLAGS] = map.clamped ? HRT_TEXTURE_CLAMPED : 0u;
    for (uint32_t axis = 0; axis < 2; ++axis) {
      words[HRT_TEXTURE_SCALE + axis] = bits(map.scale[static_cast<int>(axis)]);
      words[HRT_TEXTURE_OFFSET + axis] = bits(map.offset[static_cast<int>(axis)]);
    }
    words[HRT_TEXTURE_BASE] = bits(map.base);
    words[HRT_TEXTURE_GAIN] = bits(map.gain);
    const uint32_t record = next_record_;
    next_record_ += HRT_TEXTURE_RECORD;
    return record;
  }

  void set_materials() {
    for (size_t i = 0; i < used_.size(); ++i)
      if (used_[i] && !scene_.materials[i].maps.empty()) set_material(scene_.materials[i]);
  }

  void set_material(Material& material) {
    uint32_t* const set = &textures_.words[next_set_];
    const TextureImage* of_kind[HRT_MAP_KINDS] = {};
    for (const TextureMap& map : material.maps) {
      const TextureImage& image = images_[indices_.at(key_of(map))];
      const auto kind = static_cast<size_t>(map.kind);
      if (!image.usable_as(map.kind)) continue;
      of_kind[kind] = &image;
      if (map.kind == MapKind::holes && !image.has_holes) continue;
      set[kind] = add_record(image, map);
      any_read_[next_set_] = any_read_[next_set_] || !image.missing;
      if (!map.alone) continue;
      if (map.kind == MapKind::diffuse) material.kd = vec3(1);
      if (map.kind == MapKind::specular) material.ks = vec3(1);
      if (map.kind == MapKind::emitted) material.ke = vec3(1);
    }
    resolve_material(material);
    const TextureImage* const diffuse = of_kind[HRT_MAP_DIFFUSE];
    if (!of_kind[HRT_MAP_HOLES] && diffuse && diffuse->has_holes) set[HRT_MAP_HOLES] = set[HRT_MAP_DIFFUSE];
    if (std::any_of(set, set + HRT_MAP_KINDS, [](uint32_t record) { return record != 0; })) {
      material.texture_maps = next_set_;
      any_ = true;
    }
    next_set_ += HRT_MAP_KINDS;
  }

  void finish_triangles() {
    size_t without = 0;
    uint32_t zero = kNoIndex;
    for (size_t i = 0; i < scene_.triangle_count(); ++i) {
      const uint32_t maps = scene_.materials[scene_.triangle_materials[i]].texture_maps;
      textures_.triangle_maps.push_back(maps);
      textures_.any_holes = textures_.any_holes || textures_.has_holes(maps);
      uvec3& corners = textures_.triangle_texcoords[i];
      const bool lacks_some = corners.x == kNoIndex || corners.y == kNoIndex || corners.z == kNoIndex;
      if (!lacks_some) continue;
      without += maps != 0 && any_read_.at(maps);  // a missing file has had its warning
      if (zero == kNoIndex) {
        zero = static_cast<uint32_t>(textures_.texcoords.size());
        textures_.texcoords.push_back(vec2(0));
      }
      for (int corner = 0; corner < 3; ++corner)
        if (corners[corner] == kNoIndex) corners[corner] = zero;
    }
    if (without > 0)
      warnings_.push_back(fmt::format(
          "{} triangles have a texture but not all of their texture coordinates, which count as 0", without));
  }

  Scene& scene_;
  Textures textures_;
  ThreadPool& pool_;
  Warnings& warnings_;
  const LoadWatch& watch_;

  std::vector<bool> used_;  ///< whether each material is used
  std::vector<TextureImage> images_;
  std::map<Key, size_t> indices_;
  uint32_t sets_ = 0, records_ = 0, next_set_ = 0, next_record_ = 0;
  std::map<uint32_t, bool> any_read_;  ///< per set of maps: some image is not missing
  bool any_ = false;                   ///< some material has a texture
  size_t unreadable_ = 0;
  NameList zero_alpha_;
  std::string first_failure_;
};

}  // namespace

void load_textures(Scene& scene, Textures&& textures, ThreadPool& pool, Warnings& warnings, const LoadWatch& watch) {
  Loader(scene, std::move(textures), pool, warnings, watch).run();
}

}  // namespace hybridrt
