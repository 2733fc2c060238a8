#include "core/base/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "core/base/error.h"

namespace hybridrt {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const char* step, int error_number) {
  throw error(ErrorKind::output,
              "cannot write {}: {}: {}; check the folder, its permissions and its free space", path.string(),
              step, std::generic_category().message(error_number));
}

/// Closes on every way out; `close()` reports what the destructor cannot (NFS writes late).
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return fd_; }
  int close() { return ::close(std::exchange(fd_, -1)); }

 private:
  int fd_;
};

/// Removes the temporary unless it got its final name.
struct TemporaryGuard {
  const fs::path& path;
  bool armed = true;
  ~TemporaryGuard() {
    if (armed) ::unlink(path.c_str());
  }
};

void write_all(const fs::path& path, int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path, "write", errno);
    bytes = bytes.subspan(static_cast<size_t>(written));
  }
}

fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  // A name may fill all of the 255 bytes that file systems allow: leave room for the rest.
  const std::string name = target.filename().string().substr(0, 200);
  return target.parent_path() / fmt::format(".{}.tmp-{}-{}", name, ::getpid(), counter++);
}

/// Without this the rename itself may be lost with the power. Some file systems refuse it for folders.
void sync_folder(const fs::path& path, const fs::path& folder) {
  Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (descriptor.get() < 0) return;  // a folder that may be written but not read
  if (::fsync(descriptor.get()) != 0 && errno != EINVAL && errno != ENOTSUP)
    fail(path, "fsync of the folder", errno);
}

}  // namespace

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) fail(path, "open", EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    Descriptor stream(path, O_WRONLY);
    if (stream.get() < 0) fail(path, "open", errno);
    write_all(path, stream.get(), bytes);
    if (stream.close() != 0) fail(path, "close", errno);
    return;
  }

  std::error_code resolve_error;
  fs::path target = fs::weakly_canonical(path, resolve_error);
  if (resolve_error) target = path;  // let open say what is wrong
  if (!target.has_parent_path()) target = "." / target;

  const fs::path temporary = temporary_beside(target);
  Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
  if (file.get() < 0) fail(path, "open", errno);
  TemporaryGuard guard{temporary};
  write_all(path, file.get(), bytes);
  if (::fsync(file.get()) != 0) fail(path, "fsync", errno);
  if (file.close() != 0) fail(path, "close", errno);
  if (::rename(temporary.c_str(), target.c_str()) != 0) fail(path, "rename", errno);
  guard.armed = false;
  sync_folder(path, target.parent_path());
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace hybridrt
