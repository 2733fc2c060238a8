// EXRs that we write, read by OpenImageIO.

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/base/error.h"
#include "tests/image_io/encoded_file.h"

namespace hybridrt {
namespace {

/// Part of it noise, so that some blocks cannot be packed.
Image partly_noise(int width, int height, int channels) {
  Image image = gradient(width, height, channels);
  std::mt19937 random(static_cast<uint32_t>(width * height));
  for (size_t i = image.data.size() / 2; i < image.data.size(); ++i)
    image.data[i] = std::ldexp(static_cast<float>(random()), static_cast<int>(random() % 20) - 40);
  return image;
}

TEST(Exr, FloatsComeBackExactly) {
  constexpr std::pair<int, int> kSizes[] = {{1, 1}, {1, 33}, {33, 1}, {61, 16}, {61, 17}, {300, 100}};
  for (const auto& [width, height] : kSizes)
    for (const int channels : {1, 3, 5})
      for (const Compression compression : {Compression::fast, Compression::small}) {
        const Image image = partly_noise(width, height, channels);
        const auto bytes = encode_image(image, "exr", {{"a", "b"}}, {compression});
        const EncodedFile file(EncodedFile::as_string(bytes), "exr");
        const Image back = read_image(file.path);
        ASSERT_EQ(back.channels, channels);
        ASSERT_EQ(back.data, image.data) << width << 'x' << height << 'x' << channels;
        ASSERT_EQ(read_description(file.path), "a=b");
      }
}

TEST(Exr, HalfsAreTheNearest) {
  const Image image = partly_noise(100, 40, 3);
  const EncodeOptions half{Compression::fast, ExrNumbers::half};
  const auto bytes = encode_image(image, "exr", {}, half);
  EXPECT_LT(bytes.size(), encode_image(image, "exr").size() * 2 / 3);
  const Image back = read_image(EncodedFile(EncodedFile::as_string(bytes), "exr").path);
  for (size_t i = 0; i < image.data.size(); ++i)
    ASSERT_LE(std::abs(back.data[i] - image.data[i]), std::max(std::abs(image.data[i]) * 0x1p-11f, 0x1p-25f)) << i;
}

TEST(Exr, AValueTooLargeForHalfsMakesFloats) {
  Image image = gradient(20, 20, 3);
  const EncodeOptions half{Compression::fast, ExrNumbers::half};
  image.data[7] = 65504;
  const Image fits = read_image(EncodedFile(EncodedFile::as_string(encode_image(image, "exr", {}, half)), "exr").path);
  EXPECT_EQ(fits.data[7], 65504);
  EXPECT_NE(fits.data, image.data);
  image.data[7] = 65505;
  EXPECT_EQ(read_image(EncodedFile(EncodedFile::as_string(encode_image(image, "exr", {}, half)), "exr").path).data,
            image.data);
}

TEST(Exr, LayersKeepTheirNumbersBesideHalfs) {
  Image image = gradient(19, 35, 4);
  ImageLayer id{"id", {"id"}, {}, {}}, depth{"depth", {"Z"}, {}, {}};
  for (size_t i = 0; i < image.pixel_count(); ++i) {
    id.numbers.push_back(static_cast<uint32_t>(16777217 + i));
    depth.values.push_back(1e10f - static_cast<float>(i) * 1e5f);
  }
  image.layers = {id, depth};
  const auto bytes = encode_image(image, "exr", {}, {Compression::fast, ExrNumbers::half});
  const EncodedFile file(EncodedFile::as_string(bytes), "exr");
  const auto input = OIIO::ImageInput::open(file.path.string());
  const OIIO::ImageSpec& spec = input->spec();
  ASSERT_EQ(spec.channelnames, (std::vector<std::string>{"R", "G", "B", "A", "Z", "id"}));
  EXPECT_EQ(spec.channelformat(0), OIIO::TypeHalf);
  EXPECT_EQ(spec.channelformat(4), OIIO::TypeFloat);
  EXPECT_EQ(spec.channelformat(5), OIIO::TypeUInt32);
  std::vector<float> values(image.pixel_count());
  std::vector<uint32_t> numbers(image.pixel_count());
  ASSERT_TRUE(input->read_image(0, 0, 4, 5, OIIO::TypeFloat, values.data()));
  ASSERT_TRUE(input->read_image(0, 0, 5, 6, OIIO::TypeUInt32, numbers.data()));
  EXPECT_EQ(values, depth.values);
  EXPECT_EQ(numbers, id.numbers);
}

TEST(Exr, TheCameraIsInTheHeader) {
  Image image = gradient(8, 8, 3);
  image.camera.emplace();
  for (size_t i = 0; i < 16; ++i) {
    image.camera->camera_from_world[i] = static_cast<float>(i);
    image.camera->ndc_from_world[i] = static_cast<float>(100 + i);
  }
  const EncodedFile file(image, "exr");
  const auto input = OIIO::ImageInput::open(file.path.string());
  float matrix[16];
  ASSERT_TRUE(input->spec().getattribute("worldtocamera", OIIO::TypeMatrix, matrix));
  EXPECT_EQ(matrix[5], 5);
  ASSERT_TRUE(input->spec().getattribute("worldtoscreen", OIIO::TypeMatrix, matrix) ||
              input->spec().getattribute("worldToNDC", OIIO::TypeMatrix, matrix));
  EXPECT_EQ(matrix[5], 105);
}

}  // namespace
}  // namespace hybridrt
