#include "core/base/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include "core/base/error.h"

extern char** environ;

namespace hybridrt {
namespace {

/// The two ends of a pipe, closed with their owner.
struct Pipe {
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw error(ErrorKind::usage, "no pipe can be opened: {}; raise the limit of open files",
                  std::generic_category().message(errno));
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    ::close(ends[0]);
    close_writer();
  }
  void close_writer() {
    if (ends[1] >= 0) ::close(ends[1]);
    ends[1] = -1;
  }
  int ends[2];
};

/// What posix_spawn is told about the child's standard streams.
struct Streams {
  explicit Streams(int output) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;
  ~Streams() { posix_spawn_file_actions_destroy(&actions); }
  posix_spawn_file_actions_t actions;
};

pid_t spawn(const std::vector<std::string>& arguments, int output) {
  std::string name = "hybridrt";
  std::vector<std::string> words = arguments;
  std::vector<char*> pointers = {name.data()};
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const Streams streams(output);
  pid_t child = 0;
  const int problem = ::posix_spawn(&child, "/proc/self/exe", &streams.actions, nullptr, pointers.data(), environ);
  if (problem != 0)
    throw error(ErrorKind::usage, "no more processes can be started: {}; raise the limits of processes and memory",
                std::generic_category().message(problem));
  return child;
}

/// Reads until the child closes its output. Returns why it must be killed; empty: it need not.
std::string read_all(int from, std::chrono::milliseconds longest_silence, size_t most_bytes, std::string& output) {
  char buffer[1 << 16];
  for (;;) {
    pollfd there{from, POLLIN, 0};
    const int ready = ::poll(&there, 1, static_cast<int>(longest_silence.count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return fmt::format("did not answer for {:.3g} s", longest_silence.count() * 1e-3);
    const ssize_t count = ::read(from, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return "";
    output.append(buffer, static_cast<size_t>(count));
    if (output.size() > most_bytes) return fmt::format("answered more than {} bytes", most_bytes);
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

ChildEnd run_this_program(const std::vector<std::string>& arguments, std::chrono::milliseconds longest_silence,
                          size_t most_bytes) {
  Pipe pipe;
  const pid_t child = spawn(arguments, pipe.ends[1]);
  pipe.close_writer();
  ChildEnd end;
  try {
    end.problem = read_all(pipe.ends[0], longest_silence, most_bytes, end.output);
  } catch (...) {
    ::kill(child, SIGKILL);
    wait_for(child);
    throw;
  }
  if (!end.problem.empty()) ::kill(child, SIGKILL);
  const int status = wait_for(child);
  if (!end.problem.empty()) return end;
  if (WIFSIGNALED(status)) end.problem = fmt::format("crashed ({})", ::strsignal(WTERMSIG(status)));
  if (WIFEXITED(status) && WEXITSTATUS(status) != 0)
    end.problem = fmt::format("ended with code {}", WEXITSTATUS(status));
  return end;
}

void die_with_parent() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  pollfd reader{STDOUT_FILENO, 0, 0};  // the parent may have ended before that
  if (::poll(&reader, 1, 0) > 0 && (reader.revents & POLLERR)) ::_exit(1);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
}

}  // namespace hybridrt
