#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/exit_codes.h"

namespace CLI {
class App;
}

namespace hybridrt::cli {

/// Runs a chosen command after its options are parsed.
using Command = std::function<ExitCode()>;

/// Each adds a subcommand with its options to `app`; parsing sets `chosen` to the command to run.
void add_compare_command(CLI::App& app, Command& chosen);
void add_golden_command(CLI::App& app, Command& chosen);
void add_doctor_command(CLI::App& app, Command& chosen);
void add_inspect_command(CLI::App& app, Command& chosen);
void add_merge_command(CLI::App& app, Command& chosen);
/// `command_line`: all of it, for run.json.
void add_render_command(CLI::App& app, const std::vector<std::string>& command_line, Command& chosen);
void add_report_command(CLI::App& app, Command& chosen);
void add_scene_command(CLI::App& app, Command& chosen);
void add_simplify_command(CLI::App& app, Command& chosen);
/// `command_line`: all of it, for sweep.json.
void add_sweep_command(CLI::App& app, const std::vector<std::string>& command_line, Command& chosen);
void add_tune_command(CLI::App& app, Command& chosen);

}  // namespace hybridrt::cli
