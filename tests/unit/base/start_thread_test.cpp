// What happens when the system cannot start more threads.

#include "core/base/start_thread.h"

#include <fstream>
#include <gtest/gtest.h>
#include <pthread.h>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/render/file_sink.h"

namespace hybridrt {
namespace {

/// While it lives the process has address space for the stacks of `count` and a half more threads.
class ScarceThreads {
 public:
  explicit ScarceThreads(double count) {
    constexpr size_t kStack = size_t{1} << 29;
    pthread_attr_t attributes;
    pthread_getattr_default_np(&before_);
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, kStack);
    pthread_setattr_default_np(&attributes);
    pthread_attr_destroy(&attributes);

    size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &space_before_);
    rlimit space = space_before_;
    space.rlim_cur = pages * static_cast<size_t>(getpagesize()) + static_cast<size_t>((count + 0.5) * kStack);
    setrlimit(RLIMIT_AS, &space);
  }
  ~ScarceThreads() {
    setrlimit(RLIMIT_AS, &space_before_);
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }
  ScarceThreads(const ScarceThreads&) = delete;
  ScarceThreads& operator=(const ScarceThreads&) = delete;

 private:
  pthread_attr_t before_;
  rlimit space_before_;
};

template <typename Start>
void expect_refused(const Start& start) {
  const ScarceThreads scarce(2);
  try {
    start();
    FAIL() << "all threads were started";
  } catch (const Error& refusal) {
    EXPECT_EQ(refusal.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(refusal.what()).find("--threads"), std::string::npos) << refusal.what();
  }
}

TEST(StartThread, SaysWhatToDo) {
  std::promise<void> end;
  const std::shared_future<void> ended = end.get_future().share();
  std::vector<std::thread> threads;
  std::vector<std::future<void>> tasks;
  expect_refused([&] {
    for (int i = 0; i < 10; ++i) threads.push_back(start_thread([ended] { ended.wait(); }));
  });
  expect_refused([&] {
    for (int i = 0; i < 10; ++i) tasks.push_back(start_task([ended] { ended.wait(); }));
  });
  end.set_value();
  for (std::thread& thread : threads) thread.join();
}

TEST(StartThread, APoolStopsWhatItStarted) {
  expect_refused([] { ThreadPool pool(10); });
}

TEST(StartThread, ASinkStopsWhatItStarted) {
  const auto encode = [](const Image&, const std::filesystem::path&, const ImageMetadata&) {
    return std::vector<unsigned char>();
  };
  expect_refused([&] { FileSink sink(encode, 10, 10); });
}

}  // namespace
}  // namespace hybridrt
