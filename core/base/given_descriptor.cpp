#include "core/base/given_descriptor.h"

#include <charconv>
#include <fcntl.h>
#include <string>
#include <system_error>

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

std::optional<int> number_of(const std::string& name) {
  int number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, problem] = std::from_chars(name.data(), end, number);
  if (problem != std::errc() || stop != end || number < 0) return std::nullopt;
  return number;
}

}  // namespace

std::optional<int> descriptor_named_by(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as the kernel
  std::error_code problem;
  const fs::path descriptors = fs::canonical("/proc/self/fd", problem);
  if (problem) return std::nullopt;
  fs::path at = path;
  for (int link = 0; link < kMostLinks; ++link) {
    const fs::path folder = fs::canonical(at.has_parent_path() ? at.parent_path() : fs::path("."), problem);
    if (problem) return std::nullopt;
    if (folder == descriptors) return number_of(at.filename().string());
    at = folder / at.filename();
    if (!fs::is_symlink(at, problem)) return std::nullopt;
    at = folder / fs::read_symlink(at, problem);  // an absolute target stands alone
    if (problem) return std::nullopt;
  }
  return std::nullopt;
}

bool is_given(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFD);
  return flags >= 0 && (flags & FD_CLOEXEC) == 0;
}

}  // namespace hybridrt
