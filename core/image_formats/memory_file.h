#pragma once

#include <string>
#include <vector>

namespace hybridrt {

/// A file in memory with a name that other libraries can open, for writers that take file names only. Unlike a
/// temporary beside the result it is neither cut short by a full disk nor left behind by a crash.
class MemoryFile {
 public:
  /// Throws Error (output) when the system cannot make one.
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const;
  std::vector<unsigned char> contents() const;

 private:
  int fd_;
};

}  // namespace hybridrt
