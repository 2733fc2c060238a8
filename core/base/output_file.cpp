#include "core/base/output_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <fcntl.h>
#include <poll.h>
#include <sys/sendfile.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

#include "core/base/error.h"
#include "core/base/given_descriptor.h"
#include "core/base/interrupt.h"
#include "core/base/real_path.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  // A name may fill all of the 255 bytes that file systems allow: leave room for the rest.
  const std::string name = target.filename().string().substr(0, 200);
  return target.parent_path() / fmt::format(".{}{}{}-{}", name, kTemporaryMark, ::getpid(), counter++);
}

constexpr std::chrono::milliseconds kTick{50};
constexpr std::chrono::seconds kLongestWaitForReader{10};  // of a named pipe
constexpr std::chrono::seconds kLongestWaitToStop{1};      // for the other end, once a signal asks to stop

/// A pipe, socket or device. A named pipe may get its reader a moment later; an open() that waits could not be stopped.
/// Returns a negative number, with errno, in vain.
int open_in_place(const fs::path& path) {
  const auto give_up = std::chrono::steady_clock::now() + kLongestWaitForReader;
  for (;;) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor >= 0 || errno != ENXIO || stop_requested() || std::chrono::steady_clock::now() > give_up)
      return descriptor;
    std::this_thread::sleep_for(kTick);
  }
}

/// Waits until a pipe or the like takes bytes. False, with errno, where it will not, or a signal has asked to stop and
/// nobody reads.
bool wait_for_room(int descriptor) {
  using Clock = std::chrono::steady_clock;
  for (std::optional<Clock::time_point> give_up;;) {
    pollfd room{descriptor, POLLOUT, 0};
    const int ready = ::poll(&room, 1, static_cast<int>(kTick.count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
    if (!stop_requested()) continue;
    if (!give_up) give_up = Clock::now() + kLongestWaitToStop;
    if (Clock::now() < *give_up) continue;
    errno = ETIMEDOUT;
    return false;
  }
}

/// As write(2) of all of `bytes`, in pieces so small that a pipe with room takes one without waiting. Returns 0 or what
/// failed.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    if (!wait_for_room(descriptor)) return errno;
    const ssize_t count = ::write(descriptor, bytes.data(), std::min<size_t>(bytes.size(), PIPE_BUF));
    if (count < 0 && errno != EINTR && errno != EAGAIN) return errno;
    bytes.remove_prefix(static_cast<size_t>(std::max<ssize_t>(count, 0)));
  }
  return 0;
}

}  // namespace

OutputFile::OutputFile(const fs::path& path) : path_(path) {
  if (const std::optional<int> descriptor = descriptor_named_by(path)) {
    write_to(*descriptor);
    return;
  }
  target_ = path;
  std::error_code problem;
  const fs::file_status there = fs::status(path, problem);
  if (fs::is_directory(there)) fail("open", EISDIR);
  if (fs::exists(there) && !fs::is_regular_file(there)) {
    descriptor_ = open_in_place(target_);
  } else {
    target_ = real_path(path);
    fs::create_directories(target_.parent_path(), problem);
    if (problem) fail("make its folder", problem.value());
    temporary_ = temporary_beside(target_);
    kept_name_.emplace(temporary_, TemporaryName::Kind::file);
    descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  }
  if (descriptor_ < 0) {
    temporary_.clear();
    if (errno == ENXIO) errno = EPIPE;  // a named pipe that nobody reads
    fail("open", errno);
  }
}

OutputFile OutputFile::standard_output() { return OutputFile(STDOUT_FILENO); }

OutputFile::OutputFile(int descriptor) : path_("standard output") { write_to(descriptor); }

/// Ours are refused too: one that the caller closed may have been opened again as a file of the run.
void OutputFile::write_to(int descriptor) {
  target_.clear();
  const int mode = ::fcntl(descriptor, F_GETFL);
  if (mode < 0 || (mode & O_ACCMODE) == O_RDONLY || !is_given(descriptor)) fail("open", EBADF);
  descriptor_ = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (descriptor_ < 0) fail("open", errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::flush() {
  write_through(buffer_);
  buffer_.clear();
}

void OutputFile::write_through(std::string_view bytes) {
  if (temporary_.empty()) {
    if (const int reason = write_all(descriptor_, bytes)) fail("write", reason);
    written_ += bytes.size();
    return;
  }
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("write", errno);
    written_ += static_cast<uint64_t>(count);
    bytes.remove_prefix(static_cast<size_t>(count));
  }
}

void OutputFile::commit() {
  flush();
  if (!temporary_.empty() && ::fsync(descriptor_) != 0) fail("fsync", errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("close", errno);  // NFS may report failed writes only here
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("rename", errno);
  temporary_.clear();
  kept_name_.reset();
  sync_folder();
}

void OutputFile::checkpoint(std::string_view more) {
  if (temporary_.empty()) return;
  flush();
  OutputFile copy(path_);
  for (off_t at = 0; static_cast<uint64_t>(at) < written_;) {
    const ssize_t count = ::sendfile(copy.descriptor_, descriptor_, &at, written_ - static_cast<uint64_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail("copy", count < 0 ? errno : EIO);
  }
  copy.write(more);
  copy.commit();
}

/// Without this a power failure may undo the rename. Some file systems refuse it for folders, and some folders can be
/// written but not read.
void OutputFile::sync_folder() {
  const int folder = ::open(target_.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  const bool synced = ::fsync(folder) == 0 || errno == EINVAL || errno == ENOTSUP;
  const int reason = errno;
  ::close(folder);
  if (!synced) fail("fsync of the folder", reason);
}

void OutputFile::fail(const char* step, int reason) const {
  throw error(ErrorKind::output, "cannot write {}: {}: {}; {}", path_.string(), step,
              std::generic_category().message(reason),
              target_.empty() ? "send it elsewhere" : "check the folder, its permissions and its free space");
}

void require_writable(const fs::path& path) {
  std::error_code ignored;
  const bool is_descriptor = descriptor_named_by(path).has_value();
  const fs::file_status there = fs::status(path, ignored);
  if (is_descriptor || !fs::exists(there) || fs::is_regular_file(there) || fs::is_directory(there))
    OutputFile tried(path);
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  write_file_atomically(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace hybridrt
