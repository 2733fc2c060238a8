#include "core/base/file_claims.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/given_descriptor.h"
#include "core/base/output_file.h"
#include "core/base/real_path.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockName = ".hybridrt.lock";
constexpr int64_t kStretch = int64_t{1} << 32;  // bytes per name: more than there are frame numbers

/// Where the bytes of a name begin: the upper bits of its FNV-1a hash.
int64_t start_of(std::string_view name) {
  uint64_t hash = 14695981039346656037ull;
  for (unsigned char c : name) hash = (hash ^ c) * 1099511628211ull;
  return static_cast<int64_t>(hash >> 33) * kStretch;
}

/// For locks that belong to the open file, not to the process: no other close() in this process drops them.
struct flock bytes(short type, int64_t start, int64_t length) {
  struct flock range {};
  range.l_type = type;
  range.l_whence = SEEK_SET;
  range.l_start = start;
  range.l_len = length;  // 0: to the end of all bytes
  return range;
}

enum class Attempt { locked, taken, leaving, impossible };

Attempt try_lock(int descriptor, int64_t start, int64_t length) {
  struct flock range = bytes(F_WRLCK, start, length);
  if (::fcntl(descriptor, F_OFD_SETLK, &range) == 0) return Attempt::locked;
  if (errno != EAGAIN && errno != EACCES) return Attempt::impossible;
  // A run that ends locks all bytes for a moment, to see whether it is the last one.
  range = bytes(F_WRLCK, start, length);
  if (::fcntl(descriptor, F_OFD_GETLK, &range) != 0) return Attempt::taken;
  const bool all = range.l_start == 0 && range.l_len == 0;
  return range.l_type == F_UNLCK || all ? Attempt::leaving : Attempt::taken;
}

/// Whether `path` still names the file that is open: the last run may have removed it in between.
bool is_at(int descriptor, const fs::path& path) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
         open.st_dev == named.st_dev;
}

/// Opens a folder's lock file; whoever may write to the folder may use it. A negative number, with errno, in vain.
int open_lock(const fs::path& path) {
  const int there = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  if (there >= 0 || errno != ENOENT) return there;
  const int made = ::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (made >= 0) static_cast<void>(::fchmod(made, 0666));  // whatever the umask; it is empty, and not always our own
  return made;
}

/// A lock file of another user that may not be written: removed if no run holds any of it. False if it stays.
bool remove_stale_lock(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock all = bytes(F_WRLCK, 0, 0);
  const bool is_free = ::fcntl(descriptor, F_OFD_GETLK, &all) == 0 && all.l_type == F_UNLCK;
  ::close(descriptor);
  return is_free && ::unlink(path.c_str()) == 0;
}

[[noreturn]] void fail_at_lock(const fs::path& file, const fs::path& lock, int reason) {
  struct stat there {};
  if (reason == EACCES && ::lstat(lock.c_str(), &there) == 0 && there.st_uid != ::geteuid())
    throw error(ErrorKind::output,
                "cannot write {}: {} beside it belongs to a run of another user (number {}); wait for that run's end, "
                "have the file removed if there is none, or write elsewhere",
                file.string(), kLockName, there.st_uid);
  throw error(ErrorKind::output,
              "cannot write {}: open {} beside it: {}; check the folder and its permissions, or write elsewhere",
              file.string(), kLockName, std::generic_category().message(reason));
}

[[noreturn]] void fail(const fs::path& file, const char* step, int reason) {
  throw error(ErrorKind::output, "cannot write {}: {}: {}; check the folder and its permissions, or write elsewhere",
              file.string(), step, std::generic_category().message(reason));
}

}  // namespace

NumberedName numbered_name(const fs::path& file) {
  constexpr std::string_view kDigits = "0123456789";
  const std::string stem = file.stem().string();
  const size_t last = stem.find_last_of(kDigits);
  if (last == stem.npos) return {file.filename().string(), -1};
  const size_t before = stem.find_last_not_of(kDigits, last), begin = before == stem.npos ? 0 : before + 1;
  int64_t number = 0;
  const auto read = std::from_chars(stem.data() + begin, stem.data() + last + 1, number);
  if (read.ec != std::errc() || number >= kStretch) return {file.filename().string(), -1};
  return {stem.substr(0, begin) + "#" + stem.substr(last + 1) + file.extension().string(), number};
}

FileClaims::~FileClaims() {
  for (auto& [folder, lock] : locks_) {
    const fs::path path = folder / kLockName;
    const int descriptor = lock.descriptor;
    lock.name.reset();
    if (try_lock(descriptor, 0, 0) == Attempt::locked && is_at(descriptor, path)) ::unlink(path.c_str());
    ::close(descriptor);
  }
}

FileClaims::Answer FileClaims::claim(const fs::path& file) {
  if (descriptor_named_by(file)) return Answer::ours;
  std::error_code ignored;
  const fs::file_status there = fs::status(file, ignored);
  if (fs::exists(there) && !fs::is_regular_file(there)) return Answer::ours;
  const fs::path real = real_path(file);
  const auto [name, number] = numbered_name(real);
  return lock(real.parent_path(), start_of(name) + std::max<int64_t>(number, 0), number < 0 ? kStretch : 1, file);
}

FileClaims::Answer FileClaims::claim(const fs::path& folder, std::string_view name, int first, int last) {
  HRT_CHECK(0 <= first && first <= last);
  return lock(folder, start_of(name) + first, int64_t{last} - first + 1, folder / name);
}

void FileClaims::remove_stale_temporaries() const {
  for (const auto& [folder, lock] : locks_) {
    std::error_code unreadable;
    fs::directory_iterator entry(folder, unreadable);
    for (; !unreadable && entry != fs::directory_iterator(); entry.increment(unreadable)) {
      const std::string file = entry->path().filename().string();
      const size_t mark = file.rfind(kTemporaryMark);
      if (file[0] != '.' || mark == file.npos || mark < 2) continue;
      const auto [name, number] = numbered_name(file.substr(1, mark - 1));
      const int64_t byte = start_of(name) + std::max<int64_t>(number, 0);
      const bool is_ours = std::any_of(lock.ranges.begin(), lock.ranges.end(), [&](const auto& range) {
        return range.first <= byte && byte < range.first + range.second;
      });
      if (is_ours) ::unlink(entry->path().c_str());
    }
  }
}

FileClaims::Answer FileClaims::lock(const fs::path& named, int64_t start, int64_t length, const fs::path& shown) {
  std::error_code problem;
  fs::create_directories(named, problem);
  if (problem) fail(shown, "make its folder", problem.value());
  const fs::path folder = real_path(named), path = folder / kLockName;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const auto known = locks_.find(folder);
    const bool is_first = known == locks_.end();
    const int descriptor = is_first ? open_lock(path) : known->second.descriptor;
    if (descriptor < 0) {
      const int reason = errno;
      if (reason == EACCES && remove_stale_lock(path)) continue;
      fail_at_lock(shown, path, reason);
    }
    const Attempt got = try_lock(descriptor, start, length);
    if (got == Attempt::locked && (!is_first || is_at(descriptor, path))) {
      if (is_first) locks_[folder].name = std::make_unique<TemporaryName>(path, TemporaryName::Kind::lock, descriptor);
      locks_[folder].descriptor = descriptor;
      locks_[folder].ranges.emplace_back(start, length);
      return Answer::ours;
    }
    if (is_first) ::close(descriptor);
    if (got == Attempt::taken) return Answer::taken;
    if (got == Attempt::impossible) return Answer::unknown;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return Answer::taken;
}

}  // namespace hybridrt
