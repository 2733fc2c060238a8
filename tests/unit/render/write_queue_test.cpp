#include "core/render/write_queue.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <gtest/gtest.h>
#include <semaphore>
#include <stdexcept>
#include <vector>

namespace hybridrt {
namespace {
using namespace std::chrono_literals;

TEST(WriteQueue, OneWorkerKeepsTheOrder) {
  for (int repeat = 0; repeat < 40; ++repeat) {
    std::vector<int> order;
    WriteQueue queue(1, 100);
    for (int i = 0; i < 100; ++i) queue.submit(static_cast<size_t>(i % 7), [&order, i] { order.push_back(i); });
    queue.drain();
    ASSERT_EQ(order.size(), 100u);
    for (int i = 0; i < 100; ++i) ASSERT_EQ(order[i], i);
  }
}

TEST(WriteQueue, HoldsNoMoreThanAllowed) {
  for (int repeat = 0; repeat < 40; ++repeat) {
    std::atomic<int> done_bytes{0};
    int taken_bytes = 0, most = 0;
    WriteQueue queue(3, 100);
    for (int i = 0; i < 200; ++i) {
      const int bytes = 10 + i % 30;
      queue.submit(static_cast<size_t>(bytes), [&done_bytes, bytes] { done_bytes += bytes; });
      taken_bytes += bytes;
      most = std::max(most, taken_bytes - done_bytes);
    }
    queue.drain();
    EXPECT_LE(most, 100);
    EXPECT_EQ(done_bytes, taken_bytes);
  }
}

TEST(WriteQueue, SmallWorkWaitsInNumbersLargeWorkDoesNot) {
  std::counting_semaphore<> gate(0);
  WriteQueue queue(1, 100);
  for (int i = 0; i < 100; ++i) queue.submit(1, [&] { gate.acquire(); });  // returns, though none is done
  std::atomic<bool> taken = false;
  auto large = std::async(std::launch::async, [&] {
    queue.submit(1000, [] {});  // more than allowed: alone
    taken = true;
  });
  std::this_thread::sleep_for(30ms);
  EXPECT_FALSE(taken);
  gate.release(99);
  std::this_thread::sleep_for(30ms);
  EXPECT_FALSE(taken);
  gate.release();
  large.get();
  queue.drain();
}

TEST(WriteQueue, TheFirstFailureIsThrownOnceAndTheRestIsDone) {
  std::atomic<int> done{0};
  WriteQueue queue(2, 1000);
  for (int i = 0; i < 20; ++i) {
    try {
      queue.submit(1, [&done, i] {
        if (i == 3) throw std::runtime_error("planted");
        ++done;
      });
    } catch (const std::runtime_error&) {
      --i;  // not taken
      done = done + 100;
    }
  }
  try {
    queue.drain();
  } catch (const std::runtime_error&) {
    done = done + 100;
  }
  EXPECT_EQ(done, 119);
  EXPECT_NO_THROW(queue.drain());
}

}  // namespace
}  // namespace hybridrt
