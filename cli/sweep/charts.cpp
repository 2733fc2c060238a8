#include "cli/sweep/charts.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "core/base/error.h"

extern char** environ;

namespace hybridrt::cli {
namespace {

namespace fs = std::filesystem;

/// Beside the installed program, else among the sources that hold the folder that it was built in.
fs::path report_script() {
  std::error_code problem;
  const fs::path prefix = fs::read_symlink("/proc/self/exe", problem).parent_path().parent_path();
  const fs::path installed = prefix / "share/hybridrt/report";
  if (fs::exists(installed / "__main__.py")) return installed;
  const fs::path source = prefix.parent_path().parent_path() / "scripts/report";
  if (fs::exists(source / "__main__.py")) return source;
  throw error(ErrorKind::input, "{}: the script that draws charts is not there; install hybridrt again",
              installed.string());
}

/// Runs a program and waits for it; its exit code, or -1 if it cannot be started or is killed. What it prints is
/// appended to `printed`: the program need not know whether anybody takes it.
int run_program(const std::vector<std::string>& command, std::string& printed, bool silence_errors) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return -1;
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  if (silence_errors) posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  char block[4096];
  for (ssize_t got; (got = ::read(ends[0], block, sizeof block)) > 0 || (got < 0 && errno == EINTR);)
    if (got > 0) printed.append(block, static_cast<size_t>(got));
  ::close(ends[0]);
  if (failure != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The first Python that has Matplotlib, else the first that runs at all: the system's often has it where one that
/// stands before it in PATH does not.
std::string find_python() {
  std::string any, ignored;
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    if (run_program({python, "-c", "import matplotlib"}, ignored, true) == 0) return python;
    if (any.empty() && run_program({python, "-c", ""}, ignored, true) == 0) any = python;
  }
  if (any.empty())
    throw error(ErrorKind::input, "no charts drawn: they need python3 with Matplotlib; install python3-matplotlib");
  return any;
}

}  // namespace

ExitCode draw_charts(const fs::path& folder, bool quiet) {
  const std::string script = report_script().string(), python = find_python();
  std::string printed;
  const int code = run_program({python, script, folder.string()}, printed, false);
  if (!quiet) fmt::print("{}", printed);
  if (code == 0) return ExitCode::ok;
  return code == static_cast<int>(ExitCode::input) ? ExitCode::input : ExitCode::internal;
}

}  // namespace hybridrt::cli
