#pragma once

#include <OpenImageIO/imageio.h>
#include <filesystem>
#include <fstream>
#include <stdlib.h>
#include <string>
#include <unistd.h>

#include "core/image/srgb.h"
#include "core/image_io/encode_image.h"
#include "core/image_io/read_image.h"

namespace hybridrt {

/// Smooth, all channels different, values 0-1.
inline Image gradient(int width, int height, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        image.pixel(x, y)[c] = static_cast<float>((x + 0.5) / width * (c + 1) + (y + 0.5) / height) / (channels + 1);
  return image;
}

/// Bytes in a temporary file, removed at the end.
struct EncodedFile {
  std::filesystem::path path;

  EncodedFile(const std::string& bytes, const std::string& extension) {
    std::string name = (std::filesystem::temp_directory_path() / ("hybridrt-test-XXXXXX." + extension)).string();
    ::close(::mkstemps(name.data(), static_cast<int>(extension.size()) + 1));
    path = name;
    std::ofstream(path, std::ios::binary) << bytes;
  }
  EncodedFile(const Image& image, const std::string& format, const ImageMetadata& metadata = {})
      : EncodedFile(as_string(encode_image(image, format, metadata)), format) {}
  ~EncodedFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  EncodedFile(const EncodedFile&) = delete;
  EncodedFile& operator=(const EncodedFile&) = delete;

  static std::string as_string(const std::vector<unsigned char>& bytes) { return {bytes.begin(), bytes.end()}; }
};

/// The file's pixels in linear light: files of whole numbers go through the sRGB curve.
inline Image read_image_linear(const std::filesystem::path& path) {
  const bool floats = path.extension() == ".exr" || path.extension() == ".hdr";
  return floats ? read_image(path) : linear_from_srgb(read_image(path));
}

/// What encode_image() was handed for the file; empty where it says nothing.
inline ImageMetadata read_image_metadata(const std::filesystem::path& path) {
  const std::string description(OIIO::ImageInput::open(path.string())->spec().get_string_attribute("ImageDescription"));
  ImageMetadata metadata;
  for (size_t begin = 0; begin < description.size();) {
    const size_t end = std::min(description.find('\n', begin), description.size());
    const std::string line = description.substr(begin, end - begin);
    if (const size_t equals = line.find('='); equals != std::string::npos)
      metadata.emplace_back(line.substr(0, equals), line.substr(equals + 1));
    begin = end + 1;
  }
  return metadata;
}

}  // namespace hybridrt
