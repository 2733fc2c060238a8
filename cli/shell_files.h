#pragma once

#include <string>

namespace CLI {
class App;
}

namespace hybridrt::cli {

// Made from the commands and options that the parser knows, so that they cannot be out of date.

/// A man page (roff, section 1) of the program and all its commands.
std::string man_page(const CLI::App& app);

/// Completion for bash: commands, options, the values that an option's help lists, else files.
std::string bash_completion(const CLI::App& app);

}  // namespace hybridrt::cli
