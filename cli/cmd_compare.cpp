#include "cli/commands.h"

namespace hybridrt::cli {
void add_compare_command(CLI::App&, Command&) {}
}  // namespace hybridrt::cli
