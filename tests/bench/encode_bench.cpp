// Times what a frame costs to encode, one core, and how large its file becomes.
//   encode_bench [--rounds=N] PICTURE...
// Pictures are EXR files as `hybridrt render SCENE -o NAME.exr` writes them. Encoders take turns; medians of the rounds
// are printed in milliseconds, bytes, and both as shares of the encoder named first of its format: OpenImageIO's PNG at
// its defaults (zlib level 6, filters by trial), and its EXR of floats by ZIP. What is not ours is the same library
// with other settings.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/timing.h"
#include "core/image/srgb.h"
#include "core/image_io/encode_image.h"
#include "core/image_io/read_image.h"

namespace hybridrt {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes by_oiio(const Image& image, const char* format, OIIO::TypeDesc type, const OIIO::ParamValueList& settings) {
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  const auto writer = OIIO::ImageOutput::create(format);
  OIIO::ImageSpec spec(image.width_px, image.height_px, image.channels, type);
  for (const OIIO::ParamValue& setting : settings) spec.extra_attribs.add_or_replace(setting);
  writer->threads(1);
  writer->set_ioproxy(&proxy);
  const std::vector<uint8_t> codes = type == OIIO::TypeUInt8 ? srgb8_from_linear(image) : std::vector<uint8_t>();
  const bool written = writer->open(std::string("memory.") + format, spec) &&
                       (codes.empty() ? writer->write_image(OIIO::TypeFloat, image.data.data())
                                      : writer->write_image(OIIO::TypeUInt8, codes.data()));
  if (!writer->close() || !written) throw error(ErrorKind::output, "{}: {}", format, writer->geterror());
  return bytes;
}

Bytes oiio_png(const Image& image, int level, int filter) {
  OIIO::ParamValueList settings;
  settings.attribute("png:compressionLevel", level);
  if (filter > 0) settings.attribute("png:filter", filter);
  return by_oiio(image, "png", OIIO::TypeUInt8, settings);
}

Bytes oiio_exr(const Image& image, OIIO::TypeDesc type, const char* compression) {
  OIIO::ParamValueList settings;
  settings.attribute("compression", compression);
  return by_oiio(image, "exr", type, settings);
}

struct Encoder {
  std::string name;
  std::function<Bytes(const Image&)> encode;
  std::vector<double> ms = {};
  size_t bytes = 0;

  double median() {
    std::sort(ms.begin(), ms.end());
    return ms[ms.size() / 2];
  }
};

std::vector<Encoder> png_encoders() {
  const auto ours = [](Compression compression) {
    return [=](const Image& image) { return encode_image(image, "png", {}, {compression}); };
  };
  return {{"png libpng level 6", [](const Image& image) { return oiio_png(image, 6, 0); }},
          {"png libpng level 1, up", [](const Image& image) { return oiio_png(image, 1, 0x20); }},
          {"png ours, fast", ours(Compression::fast)},
          {"png ours, small", ours(Compression::small)}};
}

std::vector<Encoder> exr_encoders() {
  std::vector<Encoder> encoders;
  for (const auto& [name, type] : {std::pair("float", OIIO::TypeFloat), std::pair("half", OIIO::TypeHalf)})
    for (const char* compression : {"zip", "zip:1", "piz", "rle", "none"})
      encoders.push_back(
          {std::string("exr ") + name + " " + compression,
           [type = type, compression](const Image& image) { return oiio_exr(image, type, compression); }});
  for (const auto numbers : {ExrNumbers::single, ExrNumbers::half})
    for (const auto compression : {Compression::fast, Compression::small})
      encoders.push_back({"exr ours, " + std::string(name_in(kExrNumbers, numbers)) + ", " +
                              std::string(name_in(kCompressions, compression)),
                          [=](const Image& image) {
                            return encode_image(image, "exr", {}, {compression, numbers});
                          }});
  return encoders;
}

void measure(const std::string& picture, const Image& image, int rounds, std::vector<Encoder> encoders) {
  for (int round = -1; round < rounds; ++round)
    for (Encoder& encoder : encoders) {
      const Stopwatch watch;
      encoder.bytes = encoder.encode(image).size();
      if (round >= 0) encoder.ms.push_back(watch.elapsed_ms());
    }
  const double first_ms = encoders.front().median();
  const auto first_bytes = static_cast<double>(encoders.front().bytes);
  for (Encoder& encoder : encoders)
    std::printf("%s,\"%s\",%.2f,%zu,%.3f,%.3f\n", picture.c_str(), encoder.name.c_str(), encoder.median(),
                encoder.bytes, encoder.median() / first_ms, static_cast<double>(encoder.bytes) / first_bytes);
}

}  // namespace
}  // namespace hybridrt

int main(int argc, char** argv) try {
  using namespace hybridrt;
  int rounds = 11;
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  std::printf("picture,encoder,ms,bytes,ms_share,bytes_share\n");
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument.starts_with("--rounds=")) {
      rounds = std::max(1, std::atoi(argv[i] + std::string_view("--rounds=").size()));
      continue;
    }
    Image image = read_image(argv[i]);
    if (std::filesystem::path(argv[i]).extension() == ".png") image = linear_from_srgb(std::move(image));
    measure(argv[i], image, rounds, png_encoders());
    measure(argv[i], image, rounds, exr_encoders());
  }
} catch (const hybridrt::Error& problem) {
  std::fprintf(stderr, "encode_bench: %s\n", problem.what());
  return 1;
}
