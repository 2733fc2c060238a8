#include "core/base/real_path.h"

#include <system_error>

namespace hybridrt {

namespace fs = std::filesystem;

fs::path real_path(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as the kernel
  std::error_code problem;
  fs::path at = fs::absolute(path, problem);
  for (int link = 0; link < kMostLinks && !problem; ++link) {
    const fs::path folder = fs::weakly_canonical(at.parent_path(), problem);
    at = folder / at.filename();
    std::error_code missing;
    if (problem || !fs::is_symlink(fs::symlink_status(at, missing))) break;
    at = folder / fs::read_symlink(at, problem);  // an absolute target stands alone
  }
  const fs::path real = problem ? fs::path() : fs::weakly_canonical(at, problem);
  return problem || real.empty() ? path : real;
}

}  // namespace hybridrt
