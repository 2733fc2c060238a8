#include "core/base/parallel.h"

#include <atomic>
#include <gtest/gtest.h>
#include <numeric>
#include <stdexcept>

namespace hybridrt {
namespace {

TEST(ThreadPool, RunsEveryChunkOnce) {
  for (int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    std::vector<std::atomic<int>> calls(1000);
    pool.run(calls.size(), [&](size_t chunk, int worker) {
      EXPECT_LT(worker, threads);
      ++calls[chunk];
    });
    for (const auto& count : calls) EXPECT_EQ(count, 1);
  }
}

TEST(ThreadPool, CarriesAnExceptionToTheCallerAndStaysUsable) {
  ThreadPool pool(3);
  EXPECT_THROW(pool.run(100,
                        [](size_t chunk, int) {
                          if (chunk == 42) throw std::runtime_error("42");
                        }),
               std::runtime_error);
  std::atomic<int> sum = 0;
  parallel_for(pool, 10, 3, [&](size_t begin, size_t end) { sum += static_cast<int>(end - begin); });
  EXPECT_EQ(sum, 10);
}

TEST(ThreadPool, EmptyRunReturns) {
  ThreadPool pool(2);
  pool.run(0, [](size_t, int) { FAIL(); });
}

TEST(AllowedProcessors, IsAtLeastOne) { EXPECT_GE(allowed_processors(), 1); }

}  // namespace
}  // namespace hybridrt
