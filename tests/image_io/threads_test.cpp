// Pictures are read and written by several threads at once, like textures and frames.

#include <atomic>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/image_io/read_image.h"
#include "tests/image_io/encoded_file.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {

constexpr int kThreads = 4;

/// `work(i)` for each i in [0, count) on kThreads threads that start together.
void side_by_side(int count, const std::function<void(int)>& work) {
  std::atomic<int> waiting = kThreads, next = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&] {
      for (--waiting; waiting > 0;) std::this_thread::yield();
      for (int i; (i = next++) < count;) work(i);
    });
  for (std::thread& thread : threads) thread.join();
}

std::string big_endian(uint32_t number, int bytes) {
  std::string text;
  while (bytes-- > 0) text += static_cast<char>(number >> (8 * bytes));
  return text;
}

/// A display's ICC profile with `tag_count` tags that no other `seed` has.
std::string icc_profile(int seed, int tag_count) {
  const uint32_t size = 128 + 4 + 12 * static_cast<uint32_t>(tag_count) + 20, contents = size - 20;
  std::string profile = big_endian(size, 4) + std::string(8, '\0') + "mntrRGB XYZ " + std::string(12, '\0') + "acsp";
  profile.resize(128);
  profile += big_endian(static_cast<uint32_t>(tag_count), 4);
  for (int i = 0; i < tag_count; ++i)
    profile += big_endian(0x41000000u + static_cast<uint32_t>(seed * tag_count + i), 4) + big_endian(contents, 4) +
               big_endian(20, 4);
  return profile + "XYZ " + std::string(16, '\0');
}

std::string jpeg_with_profile(const std::string& profile) {
  const std::string marker = std::string("ICC_PROFILE\0\1\1", 14) + profile;
  std::string jpeg = EncodedFile::as_string(encode_image(gradient(4, 4, 3), "jpg"));
  return jpeg.insert(2, "\xFF\xE2" + big_endian(static_cast<uint32_t>(marker.size()) + 2, 2) + marker);
}

// OpenImageIO 2.4 records each tag in a map of its own, which breaks if two threads add new ones at once.
TEST(Threads, ColourProfilesAreReadSideBySide) {
  constexpr int kFiles = 40, kTags = 5000;
  std::vector<std::unique_ptr<EncodedFile>> files;
  for (int i = 0; i < kFiles; ++i)
    files.push_back(std::make_unique<EncodedFile>(jpeg_with_profile(icc_profile(i, kTags)), "jpg"));
  const std::vector<uint32_t> texels = read_texels(EncodedFile(gradient(4, 4, 3), "jpg").path, 64, 4096).texels;
  side_by_side(kFiles,
               [&](int i) { EXPECT_EQ(read_texels(files[static_cast<size_t>(i)]->path, 64, 4096).texels, texels); });
}

TEST(Threads, FormatsAreWrittenAndReadSideBySide) {
  constexpr const char* kFormats[] = {"png", "jpg",  "exr", "tif", "bmp", "tga",
                                      "hdr", "webp", "ppm", "gif", "jp2", "fits"};
  constexpr size_t kFormatCount = std::size(kFormats);
  const Image image = gradient(40, 36, 3);
  const ImageMetadata metadata = {{"settings", "40x36"}};
  std::vector<std::string> bytes(kThreads * kFormatCount);
  std::vector<Image> pictures(bytes.size());
  side_by_side(static_cast<int>(bytes.size()), [&](int i) {
    const size_t n = static_cast<size_t>(i), format = n / kThreads;  // all threads at the same format
    const EncodedFile file(image, kFormats[format], metadata);
    bytes[n] = file_contents(file.path);
    pictures[n] = read_image(file.path);
    EXPECT_THROW(read_image(EncodedFile(std::string("no picture"), kFormats[format]).path), Error);
  });
  for (size_t n = 0; n < bytes.size(); ++n) {
    const size_t first = n - n % kThreads;
    EXPECT_EQ(bytes[n], bytes[first]) << kFormats[n / kThreads];
    EXPECT_EQ(pictures[n].data, pictures[first].data) << kFormats[n / kThreads];
  }
}

}  // namespace
}  // namespace hybridrt
