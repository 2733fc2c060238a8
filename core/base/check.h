#pragma once

#include <fmt/format.h>
#include <stdexcept>

namespace hybridrt {

/// A fault of the program itself: something it promises does not hold. No user can fix it.
class CheckFailed : public std::logic_error {
  using std::logic_error::logic_error;
};

}  // namespace hybridrt

/// Always on. Ray loops use plain assert instead.
#define HRT_CHECK(condition)                                                                                 \
  do {                                                                                                       \
    if (!(condition))                                                                                        \
      throw ::hybridrt::CheckFailed(fmt::format("{}:{}: check failed: {}", __FILE__, __LINE__, #condition)); \
  } while (false)

/// Prints both expressions and both values.
#define HRT_CHECK_EQ(a, b)                                                                                         \
  do {                                                                                                             \
    const auto& hrt_a = (a);                                                                                       \
    const auto& hrt_b = (b);                                                                                       \
    if (!(hrt_a == hrt_b))                                                                                         \
      throw ::hybridrt::CheckFailed(                                                                               \
          fmt::format("{}:{}: check failed: {} == {} ({} against {})", __FILE__, __LINE__, #a, #b, hrt_a, hrt_b)); \
  } while (false)
