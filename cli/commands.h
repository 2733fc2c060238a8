#pragma once

#include <functional>

#include "cli/exit_codes.h"

namespace CLI {
class App;
}

namespace hybridrt::cli {

/// What a chosen command does once its options are parsed.
using Command = std::function<ExitCode()>;

/// Each adds one subcommand with its options to `app`; when it is chosen, `chosen` becomes what to run.
void add_compare_command(CLI::App& app, Command& chosen);
void add_golden_command(CLI::App& app, Command& chosen);
void add_doctor_command(CLI::App& app, Command& chosen);
void add_inspect_command(CLI::App& app, Command& chosen);
void add_render_command(CLI::App& app, Command& chosen);
void add_scene_command(CLI::App& app, Command& chosen);

}  // namespace hybridrt::cli
