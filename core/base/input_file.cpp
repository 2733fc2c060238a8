#include "core/base/input_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <system_error>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/given_descriptor.h"

namespace hybridrt {
namespace {

namespace fs = std::filesystem;

std::string text_of(int reason) { return std::generic_category().message(reason); }

struct Descriptor {
  int number = -1;
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

int open_to_read(const fs::path& path) {
  if (const auto given = descriptor_named_by(path); given && is_given(*given))
    return ::fcntl(*given, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  require_regular_file(path);
  return ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

}  // namespace

void require_regular_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status there = fs::status(path, ignored);
  if (!fs::exists(there) || fs::is_regular_file(there)) return;
  if (fs::is_directory(there)) throw error(ErrorKind::input, "{} is a directory; name the file in it", path.string());
  throw error(ErrorKind::input, "{} is a pipe or a device, not a file; name a file", path.string());
}

size_t read_some(int descriptor, char* to, size_t most_bytes, const std::string& what,
                 std::chrono::milliseconds longest_silence) {
  for (;;) {
    pollfd bytes{descriptor, POLLIN, 0};
    const int ready = ::poll(&bytes, 1, static_cast<int>(longest_silence.count()));
    if (ready == 0)
      throw error(ErrorKind::input,
                  "{} cannot be read: it is a pipe that has brought nothing for {} s; check what "
                  "writes to it",
                  what, std::chrono::duration_cast<std::chrono::seconds>(longest_silence).count());
    const ssize_t got = ready < 0 ? ready : ::read(descriptor, to, most_bytes);
    if (got >= 0) return static_cast<size_t>(got);
    if (errno != EINTR && errno != EAGAIN) throw error(ErrorKind::input, "{} cannot be read: {}", what, text_of(errno));
  }
}

std::string read_whole_file(const fs::path& path, size_t most_bytes, std::chrono::milliseconds longest_silence) {
  const Descriptor file(open_to_read(path));
  if (file.number < 0)
    throw error(ErrorKind::input, "{} cannot be opened: {}; check its name and permissions", path.string(),
                text_of(errno));
  std::string text;
  for (size_t have = 0, got = 1; got > 0 && have <= most_bytes; have += got) {
    text.resize(std::max<size_t>(size_t{1} << 16, 2 * have));
    got = read_some(file.number, text.data() + have, text.size() - have, path.string(), longest_silence);
    text.resize(have + got);
  }
  return text;
}

}  // namespace hybridrt
