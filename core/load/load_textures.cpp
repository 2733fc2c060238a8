#include "core/load/load_textures.h"

#include <algorithm>
#include <bit>
#include <map>
#include <span>
#include <tuple>

#include "core/base/byte_budget.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/image/mip_levels.h"
#include "core/image/srgb.h"
#include "core/load/mesh_data.h"
#include "core/load/texture_texels.h"
#include "shaders/shared.h"

namespace hybridrt {
namespace {

static_assert(static_cast<uint32_t>(MapKind::diffuse) == HRT_MAP_DIFFUSE &&
              static_cast<uint32_t>(MapKind::specular) == HRT_MAP_SPECULAR &&
              static_cast<uint32_t>(MapKind::emitted) == HRT_MAP_EMITTED &&
              static_cast<uint32_t>(MapKind::holes) == HRT_MAP_HOLES);

constexpr uint64_t kMipBytesPerTexel = 5;   // fill_mip_levels() keeps a quarter of them as sums
constexpr uint32_t kMostMapSets = 1 << 20;  // the GPU gets their indices as floats

/// An image as one kind of map uses it.
struct TextureImage {
  const TextureMap* map = nullptr;
  int width_px = 0, height_px = 0, levels = 1;
  uint64_t reading_bytes = 0;  ///< memory that it takes besides the words while it is read
  bool has_holes = false;      ///< some alpha is under one half
  bool alpha_is_zero = false;  ///< in every texel of the file: it counts as opaque
  uint32_t first = 0;          ///< index in the words of all its levels, one after the other
  bool missing = false;        ///< replaced by a checker, except for map_d
  std::string failure;         ///< why, unless the MTL reader has already said so
  std::string damage;          ///< what is wrong with pixels that are used all the same
  bool usable_as(MapKind kind) const { return kind == MapKind::diffuse || !missing; }
  bool has_levels() const { return map->kind != MapKind::holes; }
  uint64_t word_count() const {
    return has_levels() ? mip_texel_count(width_px, height_px)
                        : static_cast<uint64_t>(width_px) * static_cast<uint64_t>(height_px);
  }
};

using Key = std::tuple<std::string, bool, char, float, float>;

/// Two images differ if different texels are made of their files. That depends on -mm for map_d, since texels alone
/// decide where holes are.
Key key_of(const TextureMap& map) {
  const bool holes = map.kind == MapKind::holes;
  return {map.path.string(), holes, map.channel, holes ? map.base : 0, holes ? map.gain : 0};
}

/// Makes what is read into what the image's map uses, in its place among the words.
void prepare(TextureImage& image, TexelImage&& read, std::span<uint32_t> words) {
  const TextureMap& map = *image.map;
  image.alpha_is_zero = drop_zero_alpha(read);
  image.damage = std::move(read.damage);
  if (map.kind == MapKind::holes)
    make_opacity(read, map);
  else if (map.channel)
    for (uint32_t& texel : read.texels) texel = channel_of(texel, map.channel) * 0x010101u | 0xFF000000u;
  image.has_holes =
      std::any_of(read.texels.begin(), read.texels.end(), [](uint32_t texel) { return texel >> 24 < 128; });
  std::copy(read.texels.begin(), read.texels.end(), words.begin());
  if (image.has_levels()) image.levels = fill_mip_levels(words, image.width_px, image.height_px);
}

class Loader {
 public:
  Loader(Scene& scene, Textures&& textures, ThreadPool& pool, Warnings& warnings, const LoadWatch& watch)
      : scene_(scene), textures_(std::move(textures)), pool_(pool), warnings_(warnings), watch_(watch) {}

  void run() {
    find_images();
    if (sets_ == 0) return;
    lay_out();
    place_images();
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

  /// By their headers, in order: which ones the words have no room for does not depend on the threads.
  void place_images() {
    pool_.run(images_.size(), [&](size_t i, int) { measure(images_[i]); });
    const uint64_t most_words = std::min<uint64_t>(kMostTextureWords, watch_.most_bytes / 16);
    uint64_t words = textures_.words.size();
    for (TextureImage& image : images_) {
      if (image.missing || !image.failure.empty()) continue;
      if (words + image.word_count() > most_words) {
        image.failure = fmt::format("{}: no memory is left for it among the other textures", image.map->path.string());
        continue;
      }
      image.first = static_cast<uint32_t>(words);
      words += image.word_count();
    }
    textures_.words.resize(words);
  }

  void measure(TextureImage& image) const {
    const TextureMap& map = *image.map;
    image.missing = map.path.empty();
    if (image.missing) return;
    try {
      const TexelSize size = watch_.textures.size(map.path, kLargestTextureSide_px, kMostTexels);
      image.width_px = size.width_px, image.height_px = size.height_px;
      image.reading_bytes = size.decoding_bytes + kMipBytesPerTexel * static_cast<uint64_t>(size.width_px) *
                                                      static_cast<uint64_t>(size.height_px);
      if (image.reading_bytes > most_reading_bytes())
        image.failure = fmt::format(
            "{}: decoding its {}x{} pixels takes {} of memory, but {} are left; raise --max-memory "
            "or use a smaller image",
            map.path.string(), size.width_px, size.height_px, size_text(image.reading_bytes),
            size_text(most_reading_bytes()));
    } catch (const Error& problem) {
      image.failure = problem.what();
    }
  }

  uint64_t most_reading_bytes() const { return watch_.most_bytes / 4; }

  /// As many side by side as there is memory for.
  void read_images() {
    ByteBudget budget(most_reading_bytes());
    pool_.run(images_.size(), [&](size_t i, int) {
      TextureImage& image = images_[i];
      if (image.missing || !image.failure.empty()) return;
      const ByteBudget::Share share = budget.take(image.reading_bytes);
      read(image);
    });
    for (TextureImage& image : images_) report(image);
    if (unreadable_ > 0)
      warnings_.emplace_back(
          WarningCode::texture_unusable,
          fmt::format("{} textures cannot be used: map_Kd becomes a checker, others are left out (first: {})",
                      unreadable_, first_failure_));
    if (damaged_ > 0)
      warnings_.emplace_back(
          WarningCode::texture_damaged,
          fmt::format("{} textures are cut short or damaged, and drawn as far as they can be read (first: {})",
                      damaged_, first_damage_));
    if (zero_alpha_.count() > 0)
      warnings_.emplace_back(
          WarningCode::texture_without_alpha,
          fmt::format("{} textures have an alpha of 0 in every texel, which was taken as opaque ({})",
                      zero_alpha_.count(), zero_alpha_.text()));
  }

  void read(TextureImage& image) {
    const std::filesystem::path& path = image.map->path;
    try {
      TexelImage texels = watch_.textures.read(path, kLargestTextureSide_px, kMostTexels);
      if (texels.width_px != image.width_px || texels.height_px != image.height_px)
        throw error(ErrorKind::input, "{}: changed while it was read; run again", path.string());
      prepare(image, std::move(texels), std::span(textures_.words).subspan(image.first, image.word_count()));
    } catch (const Error& problem) {
      image.failure = problem.what();
    }
  }

  void report(TextureImage& image) {
    const std::string file = image.map->path.string();
    if (!image.failure.empty()) {
      image.missing = true;
      if (unreadable_++ == 0) first_failure_ = image.failure;
    }
    if (!image.damage.empty() && damaged_++ == 0) first_damage_ = fmt::format("{}: {}", file, image.damage);
    if (image.alpha_is_zero) zero_alpha_.add(image.map->path.filename().string());
    if (image.missing) {
      if (image.has_levels()) become_checker(image);
    } else if (std::find(scene_.files.begin(), scene_.files.end(), file) == scene_.files.end()) {
      scene_.files.push_back(file);
    }
  }

  /// All missing images share one.
  void become_checker(TextureImage& image) {
    image.width_px = image.height_px = kCheckerSide_px;
    if (checker_first_ == 0) {
      checker_first_ = static_cast<uint32_t>(textures_.words.size());
      textures_.words.resize(checker_first_ + image.word_count());
      checker_levels_ = draw_checker(std::span(textures_.words).subspan(checker_first_));
    }
    image.first = checker_first_, image.levels = checker_levels_;
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
      warnings_.emplace_back(
          WarningCode::texcoord_missing,
          fmt::format("{} triangles have a texture but not all of their texture coordinates, which count as 0",
                      without));
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
  uint32_t checker_first_ = 0;         ///< 0: none is needed so far
  int checker_levels_ = 1;
  size_t unreadable_ = 0, damaged_ = 0;
  NameList zero_alpha_;
  std::string first_failure_, first_damage_;
};

}  // namespace

void load_textures(Scene& scene, Textures&& textures, ThreadPool& pool, Warnings& warnings, const LoadWatch& watch) {
  Loader(scene, std::move(textures), pool, warnings, watch).run();
}

}  // namespace hybridrt
