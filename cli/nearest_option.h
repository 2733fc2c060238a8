#pragma once

#include <string>

namespace CLI {
class App;
}

namespace hybridrt::cli {

/// One line naming the argument that no command knows, and the nearest option of the chosen command.
std::string unknown_argument_message(const CLI::App& app);

}  // namespace hybridrt::cli
