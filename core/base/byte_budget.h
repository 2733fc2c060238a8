#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace hybridrt {

/// Memory that several threads share: who finds too little left waits until others have given theirs back. A thread may
/// hold one share at a time, else two could wait for each other.
class ByteBudget {
 public:
  class Share {
   public:
    Share(ByteBudget& budget, uint64_t bytes) : budget_(budget), bytes_(bytes) {}
    ~Share() { budget_.give_back(bytes_); }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

   private:
    ByteBudget& budget_;
    uint64_t bytes_;
  };

  explicit ByteBudget(uint64_t most_bytes) : left_(most_bytes), most_(most_bytes) {}

  /// `bytes` <= the whole budget.
  Share take(uint64_t bytes);

 private:
  void give_back(uint64_t bytes);

  std::mutex mutex_;
  std::condition_variable more_;
  uint64_t left_;
  const uint64_t most_;
};

}  // namespace hybridrt
