#include "core/base/memory.h"

#include <gtest/gtest.h>
#include <vector>

namespace hybridrt {
namespace {

TEST(AllowedMemory, IsWhatAMachineHas) {
  EXPECT_GT(allowed_memory(), uint64_t{64} << 20);
  EXPECT_LT(allowed_memory(), uint64_t{1} << 50) << "some limit is known";
}

/// Held and given back.
void touch(size_t bytes) {
  std::vector<char> block(bytes, 1);
  EXPECT_EQ(block[bytes / 2], 1);
}

TEST(PeakMemory, CountsFromTheRestart) {
  constexpr size_t kBlock = size_t{64} << 20;
  if (!restart_peak_memory()) GTEST_SKIP() << "the kernel does not restart its count";
  const uint64_t before = peak_memory_bytes();
  touch(kBlock);
  const uint64_t after = peak_memory_bytes();
  EXPECT_GE(after, before + kBlock * 9 / 10);
  ASSERT_TRUE(restart_peak_memory());
#if !defined(__SANITIZE_ADDRESS__)  // it keeps what is freed
  EXPECT_LT(peak_memory_bytes(), after - kBlock / 2);
#endif
}

}  // namespace
}  // namespace hybridrt
