#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace hybridrt {

/// An allocator that leaves new elements of plain types uninitialised.
template <typename T>
struct UninitializedAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0)
      ::new (static_cast<void*>(at)) U;
    else
      ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A vector for large arrays that all threads are about to fill: resize() touches no memory, so that the
/// pages are first touched, and zeroed, by the threads that use them.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace hybridrt
