#include "core/base/output_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

#include "core/base/error.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

OutputFile::OutputFile(const fs::path& path) : path_(path) {
  std::error_code problem;
  fs::create_directories(folder_of(path), problem);
  if (problem) fail("its folder cannot be created", problem.value());
  // rename() would replace a device node, and cannot replace a folder.
  const fs::file_status there = fs::status(path, problem);
  if (fs::exists(there) && !fs::is_regular_file(there)) fail("it is not a regular file", 0);
  if (fs::is_symlink(fs::symlink_status(path, problem))) path_ = fs::canonical(path, problem);
  if (path_.empty()) path_ = path;  // a dangling link: becomes a file

  temporary_ = folder_of(path_) / fmt::format(".{}.{}.part", path_.filename().string(), ::getpid());
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    temporary_.clear();
    fail("it cannot be created", errno);
  }
  buffer_.reserve(kBuffer);
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
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("writing failed", errno);
    written_ += count;
    bytes.remove_prefix(count);
  }
}

void OutputFile::commit() {
  flush();
  if (::fsync(descriptor_) != 0) fail("writing failed", errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("writing failed", errno);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("it cannot be put in place", errno);
  temporary_.clear();
  // The new name itself survives a power cut once the folder is on disk; some file systems cannot, and need
  // not.
  const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    ::fsync(folder);
    ::close(folder);
  }
}

void OutputFile::fail(const char* what, int reason) {
  if (reason == 0) throw error(ErrorKind::output, "{} could not be written: {}", path_.string(), what);
  throw error(ErrorKind::output, "{} could not be written: {}: {}", path_.string(), what,
              std::strerror(reason));
}

}  // namespace hybridrt
