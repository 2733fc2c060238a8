#include "core/image_formats/memory_file.h"

#include <cerrno>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "core/base/error.h"

namespace hybridrt {

MemoryFile::MemoryFile() : fd_(::memfd_create("hybridrt", MFD_CLOEXEC)) {
  if (fd_ < 0)
    throw error(ErrorKind::output, "cannot get memory to encode this picture format: {}; choose png or exr",
                std::generic_category().message(errno));
}

MemoryFile::~MemoryFile() { ::close(fd_); }

std::string MemoryFile::path() const { return fmt::format("/proc/self/fd/{}", fd_); }

std::vector<unsigned char> MemoryFile::contents() const {
  struct stat status {};
  const bool known = ::fstat(fd_, &status) == 0;
  std::vector<unsigned char> bytes(known ? static_cast<size_t>(status.st_size) : 0);
  for (size_t have = 0; known && have < bytes.size();) {
    const ssize_t got = ::pread(fd_, bytes.data() + have, bytes.size() - have, static_cast<off_t>(have));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw error(ErrorKind::output, "cannot read back an encoded picture; choose png or exr");
    have += static_cast<size_t>(got);
  }
  return bytes;
}

}  // namespace hybridrt
