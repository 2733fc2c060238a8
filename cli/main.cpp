// The command table, and the exit codes that exceptions become.

#include <CLI/CLI.hpp>
#include <clocale>
#include <cstdio>
#include <fmt/core.h>
#include <new>
#include <system_error>

#include "cli/commands.h"
#include "cli/help_formatter.h"
#include "cli/interrupt.h"
#include "cli/parse_message.h"
#include "cli/shell_files.h"
#include "cli/standard_streams.h"
#include "cli/version.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/gl/device_probe.h"
namespace hybridrt::cli {

ExitCode exit_code_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage: return ExitCode::usage;
    case ErrorKind::input: return ExitCode::input;
    case ErrorKind::device: return ExitCode::device;
    case ErrorKind::output: return ExitCode::output;
  }
  return ExitCode::internal;
}

namespace {

ExitCode fail(ExitCode code, std::string_view message) {
  complain(message);
  return code;
}

/// hybridrt help [COMMAND | --man | --bash-completion]
ExitCode help_of(const CLI::App& app, const std::string& command) {
  if (command == "--man" || command == "--bash-completion") {
    fmt::print("{}", command == "--man" ? man_page(app) : bash_completion(app));
    flush_output();
    return ExitCode::ok;
  }
  const CLI::App* of = command.empty() ? &app : nullptr;
  for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; }))
    if (known->get_name() == command) of = known;
  if (!of) return fail(ExitCode::usage, fmt::format("help {}: no such command; see 'hybridrt help'", command));
  fmt::print("{}", command.empty() ? app.help() : of->help("hybridrt"));
  flush_output();
  return ExitCode::ok;
}

/// What the command line asks for, after parsing.
struct Asked {
  Command command;
  bool version = false, as_json = false;
};

void add_commands(CLI::App& app, const std::vector<std::string>& command_line, Asked& asked) {
  app.formatter(std::make_shared<HelpFormatter>());
  app.footer(
      "'hybridrt COMMAND --help' tells more. Examples:\n"
      "  hybridrt render scene:chess\n"
      "  hybridrt inspect car.obj");
  app.require_subcommand(0, 1);
  app.add_flag("--version", asked.version, "Version, commit, compiler, libraries");
  app.add_flag("--json", asked.as_json, "With --version: as one JSON object, with the GL renderer");
  add_render_command(app, command_line, asked.command);
  add_merge_command(app, asked.command);
  add_sweep_command(app, command_line, asked.command);
  add_report_command(app, asked.command);
  add_tune_command(app, asked.command);
  add_simplify_command(app, asked.command);
  add_compare_command(app, asked.command);
  add_golden_command(app, asked.command);
  add_scene_command(app, asked.command);
  add_inspect_command(app, asked.command);
  add_doctor_command(app, asked.command);
}

/// Throws what the command throws.
ExitCode parse_and_run(CLI::App& app, int argc, char** argv, const Asked& asked) {
  if (argc <= 1) {
    say(app.help());
    return ExitCode::usage;
  }
  if (std::string_view(argv[1]) == "help") return help_of(app, argc > 2 ? argv[2] : "");
  bool help = false;
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    help = true;
  }
  ExitCode code = ExitCode::ok;
  if (help)
    fmt::print("{}", app.help());
  else if (asked.command)
    code = asked.command();
  else if (asked.version)
    code = print_version(asked.as_json);
  flush_output();
  return code;
}

ExitCode run(int argc, char** argv) {
  CLI::App app{"hybridrt: headless hybrid CPU-GPU renderer of frame sequences", "hybridrt"};
  Asked asked;
  add_commands(app, std::vector<std::string>(argv, argv + argc), asked);
  try {
    return parse_and_run(app, argc, argv, asked);
  } catch (const CLI::ParseError& parse_error) {
    return fail(ExitCode::usage, in_one_line(parse_message(app, parse_error)));
  } catch (const Error& wrong_world) {
    return fail(interrupted_or(exit_code_of(wrong_world.kind())), wrong_world.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::usage, "out of memory; render a smaller scene or picture");
  } catch (const std::system_error& problem) {
    if (std::ferror(stdout)) return fail(ExitCode::output, output_error(problem.code().message()).what());
    return fail(ExitCode::internal, fmt::format("internal error: {}", problem.what()));
  } catch (const std::exception& our_mistake) {
    return fail(ExitCode::internal, fmt::format("internal error: {}", our_mistake.what()));
  }
}

}  // namespace
}  // namespace hybridrt::cli

int main(int argc, char** argv) {
  if (argc > 1 && argv[1] == std::string_view(hybridrt::gl::kProbeArgument))
    return hybridrt::gl::answer_probe({argv + 2, argv + argc});
  hybridrt::cli::prepare_standard_streams();
  hybridrt::catch_signals();
  std::setlocale(LC_ALL, "C");  // numbers are read and written alike everywhere
  return static_cast<int>(hybridrt::cli::run(argc, argv));
}
