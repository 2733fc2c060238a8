#include "cli/commands.h"

namespace hybridrt::cli {
void add_scene_command(CLI::App&, Command&) {}
}  // namespace hybridrt::cli
