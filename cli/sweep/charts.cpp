#include "cli/sweep/charts.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include "cli/standard_streams.h"
#include "core/base/error.h"

extern char** environ;

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

/// Beside the installed program, else among the sources that it was built from.
fs::path report_script() {
  std::error_code problem;
  const fs::path binary = fs::read_symlink("/proc/self/exe", problem);
  const fs::path installed = binary.parent_path().parent_path() / "share/hybridrt/report";
  if (fs::exists(installed / "__main__.py")) return installed;
  const fs::path source = HYBRIDRT_REPORT_SOURCE;
  if (fs::exists(source / "__main__.py")) return source;
  throw error(ErrorKind::input, "{}: the script that draws charts is not there; install hybridrt again",
              installed.string());
}

}  // namespace

ExitCode draw_charts(const fs::path& folder) {
  flush_output();  // what the script prints follows
  const std::string script = report_script().string(), where = folder.string();
  const char* const arguments[] = {"python3", script.c_str(), where.c_str(), nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, "python3", nullptr, nullptr, const_cast<char* const*>(arguments), environ);
  if (failure != 0)
    throw error(ErrorKind::input, "{}: no charts drawn: python3 cannot be started ({}); install python3 and Matplotlib",
                where, std::strerror(failure));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return ExitCode::ok;
  return WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ExitCode::input) ? ExitCode::input
                                                                                       : ExitCode::internal;
}

}  // namespace hybridrt::cli
