#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/exit_codes.h"

namespace hybridrt::cli {

extern const char* const kVersion;   ///< the program's version
extern const char* const kCommit;    ///< the commit that it was built from; "unknown" outside a checkout
extern const char* const kCompiler;  ///< name and version

/// The libraries that pixels and times depend on, with the versions that the program was built with.
nlohmann::ordered_json library_versions();

/// `hybridrt --version`: all of that; as JSON also the GL renderer, if a context can be opened, which takes a while.
ExitCode print_version(bool as_json);

}  // namespace hybridrt::cli
