#include "core/render/file_sink.h"

#include <atomic>
#include <chrono>
#include <fmt/format.h>
#include <future>
#include <gtest/gtest.h>
#include <semaphore>
#include <stdexcept>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {
namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::vector<unsigned char> bytes_of(const Image& image) {
  return {static_cast<unsigned char>(image.data[0]), static_cast<unsigned char>(image.data.size())};
}

constexpr size_t kBytes = 8;  // of each picture
Image numbered(int number) { return Image(2, 1, 1, static_cast<float>(number)); }

TEST(FileSink, WritesEveryPictureUnderItsOwnName) {
  const TemporaryFolder folder;
  std::atomic<int> turn{0};
  std::vector<double> times_ms;  // `done` runs one at a time, so this needs no lock
  {
    // Early pictures take longest, so that the order of finishing is not the order of submitting.
    FileSink sink(
        [&](const Image& image, const fs::path&, const ImageMetadata&) {
          if (turn++ < 3) std::this_thread::sleep_for(20ms);
          return bytes_of(image);
        },
        3, 5 * kBytes);
    for (int i = 0; i < 30; ++i)
      sink.submit(folder.path / (fmt::format("f{}", i)), numbered(i), [&](double ms) { times_ms.push_back(ms); });
    sink.drain();
    EXPECT_EQ(times_ms.size(), 30u);
  }
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(file_contents(folder.path / (fmt::format("f{}", i))), (std::string{static_cast<char>(i), 2})) << i;
  EXPECT_EQ(folder.names().size(), 30u);
  for (const double ms : times_ms) EXPECT_GT(ms, 0);
}

TEST(FileSink, DestructorFinishesTheQueue) {
  const TemporaryFolder folder;
  {
    FileSink sink([](const Image& image, const fs::path&, const ImageMetadata&) { return bytes_of(image); }, 1,
                  50 * kBytes);
    for (int i = 0; i < 50; ++i) sink.submit(folder.path / std::to_string(i), numbered(i));
  }
  EXPECT_EQ(folder.names().size(), 50u);
}

TEST(FileSink, SubmitBlocksWhileTheQueueIsFull) {
  const TemporaryFolder folder;
  std::counting_semaphore<> gate(0);
  FileSink sink(
      [&](const Image& image, const fs::path&, const ImageMetadata&) {
        gate.acquire();
        return bytes_of(image);
      },
      1, 3 * kBytes);
  std::atomic<int> submitted{0};
  auto producer = std::async(std::launch::async, [&] {
    for (int i = 0; i < 6; ++i, ++submitted) sink.submit(folder.path / std::to_string(i), numbered(i));
  });
  // One in progress and two waiting; the fourth must not be accepted.
  for (int i = 0; i < 2000 && submitted < 3; ++i) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(submitted, 3);
  gate.release();
  for (int i = 0; i < 2000 && submitted < 4; ++i) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(submitted, 4);
  gate.release(100);
  producer.get();
  sink.drain();
  EXPECT_EQ(folder.names().size(), 6u);
}

TEST(FileSink, CarriesAFailureOnceAndGoesOn) {
  const TemporaryFolder folder;
  FileSink sink(
      [](const Image& image, const fs::path&, const ImageMetadata&) {
        if (image.data[0] == 1) throw error(ErrorKind::output, "planted");
        return bytes_of(image);
      },
      2, 6 * kBytes);
  int done = 0;
  for (int i = 0; i < 3; ++i) {
    try {
      sink.submit(folder.path / std::to_string(i), numbered(i), [&](double) { ++done; });
    } catch (const Error&) {
      --i;  // an earlier failure was thrown: this one was not taken
    }
    if (i == 1) {
      try {
        sink.drain();
        ADD_FAILURE() << "the failure was lost";
      } catch (const Error& failure) {
        EXPECT_STREQ(failure.what(), "planted");
      }
    }
  }
  EXPECT_NO_THROW(sink.drain());
  EXPECT_EQ(folder.names(), (std::set<std::string>{"0", "2"}));
  EXPECT_EQ(done, 2) << "not for the failed one";
}

TEST(FileSink, WakesASubmitThatWaitsWhenAPictureFails) {
  const TemporaryFolder folder;
  std::counting_semaphore<> gate(0);
  FileSink sink(
      [&](const Image& image, const fs::path&, const ImageMetadata&) -> std::vector<unsigned char> {
        gate.acquire();
        if (image.data[0] == 0) throw std::runtime_error("planted");
        return bytes_of(image);
      },
      1, 2 * kBytes);
  auto producer = std::async(std::launch::async, [&] {
    for (int i = 0; i < 10; ++i) sink.submit(folder.path / std::to_string(i), numbered(i));
  });
  gate.release(1);
  EXPECT_THROW(producer.get(), std::runtime_error);
  gate.release(100);
}

TEST(FileSink, MakesTheFolderOrSaysWhyNot) {
  const TemporaryFolder folder;
  FileSink sink([](const Image& image, const fs::path&, const ImageMetadata&) { return bytes_of(image); }, 2,
                6 * kBytes);
  for (int i = 0; i < 8; ++i) sink.submit(folder.path / "deep/er" / std::to_string(i), numbered(i));
  sink.drain();
  EXPECT_TRUE(fs::is_regular_file(folder.path / "deep/er/7"));

  sink.submit(folder.path / "deep/er/7/below/a", numbered(1));
  try {
    sink.drain();
    ADD_FAILURE() << "a folder below a file was made";
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::output);
    EXPECT_NE(std::string(failure.what()).find("deep/er/7/below"), std::string::npos) << failure.what();
  }
}

TEST(FileSink, UnaskedFailureDoesNotEndTheProcess) {
  FileSink sink([](const Image&, const fs::path&, const ImageMetadata&) -> std::vector<unsigned char> { throw 42; }, 1,
                2 * kBytes);
  sink.submit("/nowhere/a", numbered(1));
}

}  // namespace
}  // namespace hybridrt
