#pragma once

#include "core/base/error.h"

namespace hybridrt::cli {

/// README.md lists these and no others.
enum class ExitCode {
  ok = 0,
  some_failed = 1,  ///< the others are there
  usage = 2,        ///< also out of memory: more was asked for than the machine has
  input = 3,
  device = 4,
  output = 5,
  images_differ = 6,
  internal = 70,  ///< our own mistake, not the user's
  interrupted = 130,
  terminated = 143,
};

ExitCode exit_code_of(ErrorKind kind);

}  // namespace hybridrt::cli
