#include "core/base/byte_budget.h"

#include "core/base/check.h"

namespace hybridrt {

ByteBudget::Share ByteBudget::take(uint64_t bytes) {
  HRT_CHECK(bytes <= most_);
  std::unique_lock lock(mutex_);
  more_.wait(lock, [&] { return bytes <= left_; });
  left_ -= bytes;
  return Share(*this, bytes);
}

void ByteBudget::give_back(uint64_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    left_ += bytes;
  }
  more_.notify_all();
}

}  // namespace hybridrt
