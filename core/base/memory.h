#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hybridrt {

/// Bytes of main memory that this process may use in all: the machine's, further limited by the cgroup (version 1 or
/// 2). UINT64_MAX where neither gives a limit.
uint64_t allowed_memory();

/// Bytes of a vector's elements.
template <typename T>
size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

/// Gives freed memory back and starts the count of peak_memory_bytes() anew. False where the kernel does not let us.
bool restart_peak_memory();

/// The most main memory that this process has held since restart_peak_memory(), or since it began; 0 if not known.
uint64_t peak_memory_bytes();

/// For people: "12.5 MiB", "3.0 GiB".
std::string size_text(uint64_t bytes);

}  // namespace hybridrt
