#include <cstddef>
#include <cstdint>

#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t count) {
  hybridrt::fuzz::takes({reinterpret_cast<const char*>(bytes), count});
  return 0;
}
