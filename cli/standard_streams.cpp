#include "cli/standard_streams.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace hybridrt::cli {

namespace {

/// Like gnulib's stdopen: opened for the wrong direction. The device refuses writers who reopen /dev/stdout too; the
/// root folder is there even where no device is.
void fill(int stream) {
  if (::fcntl(stream, F_GETFD) >= 0) return;
  if (::open("/dev/full", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) ::open("/", O_RDONLY);
}

}  // namespace

void prepare_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) fill(stream);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void say(std::string_view text) noexcept { std::fwrite(text.data(), 1, text.size(), stderr); }

void complain(std::string_view message) noexcept {
  std::fprintf(stderr, "hybridrt: %.*s\n", static_cast<int>(message.size()), message.data());  // in one write
}

void flush_output() {
  if (std::fflush(stdout) != 0) throw output_error(std::generic_category().message(errno));
  if (std::ferror(stdout)) throw output_error("an earlier write failed");
}

Error output_error(const std::string& reason) {
  return error(ErrorKind::output, "standard output cannot be written: {}; send the results elsewhere", reason);
}

}  // namespace hybridrt::cli
