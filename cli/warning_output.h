#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/base/warnings.h"

namespace hybridrt::cli {

/// "TEXT [CODE]", in one line.
std::string text_of(const Warning& warning);

/// "hybridrt: warning: TEXT [CODE]": what people read on standard error.
std::string line_of(const Warning& warning);

/// Writes that line to standard error.
void warn(const Warning& warning);

/// {"code": CODE, "message": TEXT}: what scripts read.
nlohmann::ordered_json json_of(const Warning& warning);
nlohmann::ordered_json json_of(const Warnings& warnings);

}  // namespace hybridrt::cli
