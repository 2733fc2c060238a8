#pragma once

#include <dlfcn.h>

#include "core/base/error.h"

namespace hybridrt::gl {

/// A shared library opened at run time, privately (RTLD_LOCAL: libOSMesa exports every gl* symbol and would shadow the
/// driver's). Throws Error(device) if it is not installed.
class Library {
 public:
  explicit Library(const char* name) : handle_(dlopen(name, RTLD_NOW | RTLD_LOCAL)), name_(name) {
    if (!handle_) throw error(ErrorKind::device, "{} is not installed", name);
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  // Never dlclosed: drivers leave threads and thread-local destructors behind.

  template <typename FunctionPointer>
  FunctionPointer symbol(const char* name) const {
    auto* address = reinterpret_cast<FunctionPointer>(dlsym(handle_, name));
    if (!address) throw error(ErrorKind::device, "{} lacks {}", name_, name);
    return address;
  }

 private:
  void* handle_;
  const char* name_;
};

}  // namespace hybridrt::gl
