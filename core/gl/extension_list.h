#pragma once

#include <string_view>

namespace hybridrt::gl {

/// True if `name` is one of the names, separated by spaces, in an extension string of EGL or GL. `all` may be null: no
/// extensions.
bool lists_extension(const char* all, std::string_view name);

}  // namespace hybridrt::gl
