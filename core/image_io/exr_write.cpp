#include "core/image_io/exr_write.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <openexr.h>
#include <span>

#include "core/base/error.h"
#include "core/image/srgb.h"
#include "core/image_io/deflate.h"
#include "core/image_io/exr_channels.h"

namespace hybridrt {
namespace {

using Bytes = std::vector<unsigned char>;

/// A file that OpenEXR writes into memory.
class ExrFile {
 public:
  ExrFile(const std::string& name, Bytes& bytes) : name_(name) {
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.user_data = &bytes;
    settings.write_fn = write;
    settings.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};  // else standard error
    check(exr_start_write(&context_, "memory.exr", EXR_WRITE_FILE_DIRECTLY, &settings));
  }
  ~ExrFile() { exr_finish(&context_); }
  ExrFile(const ExrFile&) = delete;
  ExrFile& operator=(const ExrFile&) = delete;

  operator exr_context_t() const { return context_; }
  void check(exr_result_t result) const {
    if (result != EXR_ERR_SUCCESS)
      throw error(ErrorKind::output, "{}: cannot be encoded: {}; choose another format or size", name_,
                  exr_get_error_code_as_string(result));
  }
  /// With the table of the blocks' places, which comes last.
  void finish() { check(exr_finish(&context_)); }

 private:
  static int64_t write(exr_const_context_t, void* to, const void* from, uint64_t count, uint64_t offset,
                       exr_stream_error_func_ptr_t) {
    Bytes& bytes = *static_cast<Bytes*>(to);
    try {
      bytes.resize(std::max<size_t>(bytes.size(), offset + count));
    } catch (const std::bad_alloc&) {
      return -1;
    }
    std::memcpy(bytes.data() + offset, from, count);
    return static_cast<int64_t>(count);
  }

  const std::string& name_;
  exr_context_t context_ = nullptr;
};

/// Colours times alpha, as EXR holds them.
Image associated(Image image) {
  const int alpha = alpha_channel(image.channels);
  for (size_t first = 0; alpha >= 0 && first < image.data.size(); first += image.channels)
    for (int c = 0; c < alpha; ++c) image.data[first + c] *= image.data[first + alpha];
  return image;
}

void require_finite_layers(const Image& image, const std::string& name) {
  for (const ImageLayer& layer : image.layers)
    for (float value : layer.values)
      if (!std::isfinite(value))
        throw error(ErrorKind::output, "{}: not written: its layer {} has a value that is not a finite number", name,
                    layer.name);
}

void write_header(const ExrFile& file, const Image& image, const std::vector<ExrChannel>& channels,
                  const std::string& description) {
  int part = 0;
  file.check(exr_add_part(file, nullptr, EXR_STORAGE_SCANLINE, &part));
  file.check(exr_initialize_required_attr_simple(file, part, image.width_px, image.height_px, EXR_COMPRESSION_ZIP));
  for (const ExrChannel& channel : channels) {
    const exr_pixel_type_t type = channel.type == ExrType::whole  ? EXR_PIXEL_UINT
                                  : channel.type == ExrType::half ? EXR_PIXEL_HALF
                                                                  : EXR_PIXEL_FLOAT;
    file.check(exr_add_channel(file, part, channel.name.c_str(), type, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
  }
  if (!description.empty()) file.check(exr_attr_set_string(file, part, "comments", description.c_str()));
  if (image.camera) {
    exr_attr_m44f_t matrix;
    std::copy(image.camera->camera_from_world.begin(), image.camera->camera_from_world.end(), matrix.m);
    file.check(exr_attr_set_m44f(file, part, "worldToCamera", &matrix));
    std::copy(image.camera->ndc_from_world.begin(), image.camera->ndc_from_world.end(), matrix.m);
    file.check(exr_attr_set_m44f(file, part, "worldToNDC", &matrix));
  }
  file.check(exr_write_header(file));
}

/// The bytes of a block apart, those at even places before those at odd ones, then each as its difference from the one
/// before: what OpenEXR's ZIP packs.
void take_apart(std::span<const uint8_t> block, std::span<uint8_t> scratch, std::span<uint8_t> out) {
  const size_t half = block.size() / 2;  // values have two bytes or four
  for (size_t i = 0; i < half; ++i) {
    scratch[i] = block[2 * i];
    scratch[half + i] = block[2 * i + 1];
  }
  out[0] = scratch[0];
  for (size_t i = 1; i < block.size(); ++i) out[i] = static_cast<uint8_t>(scratch[i] - scratch[i - 1] + 128);
}

}  // namespace

std::vector<unsigned char> encode_exr(const Image& linear, const std::string& name, const std::string& description,
                                      const EncodeOptions& options) {
  constexpr int kBlockRows = 16;  // of EXR_COMPRESSION_ZIP
  require_finite_layers(linear, name);
  const bool has_alpha = alpha_channel(linear.channels) >= 0;
  const Image times_alpha = has_alpha ? associated(linear) : Image();
  const Image& image = has_alpha ? times_alpha : linear;
  const std::vector<ExrChannel> channels = exr_channels(image, options.exr);
  size_t row_bytes = 0;
  for (const ExrChannel& channel : channels) row_bytes += channel.value_bytes() * static_cast<size_t>(image.width_px);

  Bytes bytes;
  ExrFile file(name, bytes);
  write_header(file, image, channels, description);
  PackedBytes block(row_bytes * kBlockRows), scratch(block.size()), apart(block.size());
  FastDeflate fast;
  for (int y = 0; y < image.height_px; y += kBlockRows) {
    const int rows = std::min(kBlockRows, image.height_px - y);
    uint8_t* end = block.data();
    for (int row = y; row < y + rows; ++row)
      for (const ExrChannel& channel : channels)
        end = write_values(channel, static_cast<size_t>(row) * image.width_px, image.width_px, end);
    const std::span<const uint8_t> raw(block.data(), end);
    take_apart(raw, scratch, apart);
    const std::span<const uint8_t> to_pack(apart.data(), raw.size());
    PackedBytes small;
    if (options.compression == Compression::small) {
      small = deflate_small(to_pack);
    } else {
      fast.restart();
      fast.add(to_pack, true);
    }
    const PackedBytes& packed = options.compression == Compression::small ? small : fast.packed();
    const bool worth = packed.size() < raw.size();  // else a block is as it was
    file.check(
        exr_write_scanline_chunk(file, 0, y, worth ? packed.data() : raw.data(), worth ? packed.size() : raw.size()));
  }
  file.finish();
  return bytes;
}

}  // namespace hybridrt
