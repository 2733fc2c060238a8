#pragma once

#include <filesystem>

namespace hybridrt {

/// Keeps the name of a temporary file (of a folder that holds one, of a lock file) until its end, for
/// remove_temporary_files(). The names are the process's, not an object's: a signal handler has nothing else to find
/// them by. Where very many are kept at once, or a name is longer than the system takes, some are not remembered.
class TemporaryName {
 public:
  enum class Kind {
    file,
    folder,
    lock  ///< a file that other processes lock too: it stays while one of them does
  };
  /// `descriptor`: of the open lock file, which outlives this object.
  TemporaryName(const std::filesystem::path& path, Kind kind, int descriptor = -1);
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

 private:
  int slot_ = -1;
};

/// Removes what the names kept now stand for. May be called from a signal handler that ends the process.
void remove_temporary_files() noexcept;

}  // namespace hybridrt
