// Preloaded, it makes every file system one without locks, as some network mounts are.

#include <cerrno>
#include <cstdarg>
#include <dlfcn.h>
#include <fcntl.h>

extern "C" int fcntl(int descriptor, int command, ...) {
  va_list arguments;
  va_start(arguments, command);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  if (command == F_OFD_SETLK || command == F_OFD_GETLK) {
    errno = ENOLCK;
    return -1;
  }
  using Fcntl = int (*)(int, int, ...);
  return reinterpret_cast<Fcntl>(::dlsym(RTLD_NEXT, "fcntl64"))(descriptor, command, argument);
}

// The same function under the C library's other name for it.
extern "C" int fcntl64(int descriptor, int command, ...) __attribute__((alias("fcntl")));
