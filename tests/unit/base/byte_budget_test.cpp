#include "core/base/byte_budget.h"

#include <atomic>
#include <gtest/gtest.h>
#include <random>
#include <thread>
#include <vector>

namespace hybridrt {
namespace {

TEST(ByteBudget, NeverGivesMoreThanThereIs) {
  for (unsigned run = 0; run < 40; ++run) {
    constexpr uint64_t kMost = 100;
    ByteBudget budget(kMost);
    std::atomic<uint64_t> held = 0, most_held = 0;
    const auto work = [&](unsigned seed) {
      std::mt19937 random(seed);
      for (int i = 0; i < 200; ++i) {
        const uint64_t bytes = random() % (kMost + 1);
        const ByteBudget::Share share = budget.take(bytes);
        const uint64_t now = held += bytes;
        for (uint64_t most = most_held; most < now && !most_held.compare_exchange_weak(most, now);) continue;
        held -= bytes;
      }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < 4; ++i) threads.emplace_back(work, 4 * run + i);
    for (std::thread& thread : threads) thread.join();
    EXPECT_LE(most_held, kMost);
    const ByteBudget::Share all = budget.take(kMost);  // all of it has come back, or this waits for ever
  }
}

}  // namespace
}  // namespace hybridrt
