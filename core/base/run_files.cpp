#include "core/base/run_files.h"

#include <sys/stat.h>

#include "core/base/error.h"
#include "core/base/real_path.h"

namespace hybridrt {
namespace fs = std::filesystem;

std::string file_identity(const fs::path& path) {
  struct stat file {};
  const fs::path real = real_path(path);  // its folders may be missing on a detour
  if (::stat(path.c_str(), &file) == 0 || ::stat(real.c_str(), &file) == 0)
    return S_ISCHR(file.st_mode) || S_ISBLK(file.st_mode) ? "" : fmt::format("{}:{}", file.st_dev, file.st_ino);
  return real.string();
}

void RunFiles::reads(const fs::path& path) {
  if (std::string identity = file_identity(path); !identity.empty())
    uses_.try_emplace(std::move(identity), Use{path, ""});
}

void RunFiles::require_unused(const fs::path& path, std::string_view what) const {
  const auto known = uses_.find(file_identity(path));
  if (known == uses_.end()) return;
  const auto& [other, other_what] = known->second;
  const std::string also = other == path ? "" : fmt::format(" (as {})", other.string());
  if (other_what.empty())
    throw error(ErrorKind::usage, "{} {}: the run reads that file{} and would write over it; choose another name", what,
                path.string(), also);
  throw error(ErrorKind::usage, "{} {}: {} goes to that file too{}; choose another name", what, path.string(),
              other_what, also);
}

void RunFiles::writes(const fs::path& path, std::string_view what) {
  require_unused(path, what);
  if (std::string identity = file_identity(path); !identity.empty())
    uses_.try_emplace(std::move(identity), Use{path, std::string(what)});
}

std::vector<fs::path> RunFiles::paths() const {
  std::vector<fs::path> all;
  for (const auto& [identity, use] : uses_) all.push_back(use.path);
  return all;
}

}  // namespace hybridrt
