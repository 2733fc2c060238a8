#pragma once

#include <string_view>

namespace hybridrt::gl {

/// True if `name` is one of the whole names, set apart by spaces, of an extension string as EGL and GL give it. `all`
/// may be null: no extensions.
bool lists_extension(const char* all, std::string_view name);

}  // namespace hybridrt::gl
