#include "cli/sweep/sweep_files.h"

#include <system_error>

#include "core/base/error.h"

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

bool is_chart(const fs::path& file) { return file.extension() == ".png" || file.extension() == ".svg"; }

bool is_same_folder(const fs::path& a, const fs::path& b) {
  std::error_code missing;
  return fs::equivalent(a.empty() ? fs::path(".") : a, b.empty() ? fs::path(".") : b, missing);
}

}  // namespace

void require_sweep_writes_none_of(const RunFiles& read, const SweepRequest& request) {
  for (const fs::path& file : {request.rows(), request.facts(), request.folder / "report.html"})
    read.require_unused(file, "-o");
  for (const fs::path& file : read.paths()) {
    const fs::path folder = file.parent_path();
    if ((is_chart(file) && is_same_folder(folder, request.folder)) || is_same_folder(folder, request.pictures()) ||
        is_same_folder(folder, request.folder / "truth"))
      throw error(ErrorKind::usage, "-o {}: the sweep reads {} there and may write over it; choose another folder",
                  request.folder.string(), file.string());
  }
}

}  // namespace hybridrt::cli
