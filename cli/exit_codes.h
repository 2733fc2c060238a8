#pragma once

#include "core/base/error.h"

namespace hybridrt::cli {

enum class ExitCode {
  ok = 0,
  some_frames_failed = 1,
  usage = 2,
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
