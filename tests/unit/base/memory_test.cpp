#include "core/base/memory.h"

#include <gtest/gtest.h>

namespace hybridrt {
namespace {

TEST(AllowedMemory, IsWhatAMachineHas) {
  EXPECT_GT(allowed_memory(), uint64_t{64} << 20);
  EXPECT_LT(allowed_memory(), uint64_t{1} << 50) << "some limit is known";
}

}  // namespace
}  // namespace hybridrt
