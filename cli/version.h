#pragma once

#include <nlohmann/json_fwd.hpp>

namespace hybridrt::cli {

extern const char* const kVersion;   ///< of the program
extern const char* const kCommit;    ///< that it was built from; "unknown" outside a checkout
extern const char* const kCompiler;  ///< name and version

/// The libraries that pixels and times depend on, with the versions that this program was built with.
nlohmann::ordered_json library_versions();

}  // namespace hybridrt::cli
