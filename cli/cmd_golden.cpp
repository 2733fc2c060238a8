#include <CLI/CLI.hpp>

#include "cli/commands.h"
#include "cli/golden/golden_case.h"

namespace hybridrt::cli {
namespace {

constexpr const char* kListHelp = "List of cases (default: the project's own)";

void add_init(CLI::App& golden, Command& chosen) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = golden.add_subcommand("init", "Make an empty list, DIR/golden.json");
  command->add_option("dir", *folder, "Folder for the list and its pictures")->type_name("DIR")->required();
  command->callback([folder, &chosen] { chosen = [folder] { return golden_init(*folder); }; });
}

void add_add(CLI::App& golden, Command& chosen) {
  auto addition = std::make_shared<GoldenAddition>();
  CLI::App* command = golden.add_subcommand(
      "add",
      "Add a case: renders its expected pictures. All other OPTIONS are those of render, --gl off if none is given");
  command->add_option("name", addition->name, "Its name, and that of its pictures")->type_name("NAME")->required();
  command->add_option("scene", addition->scene, "Its scene")->type_name("SCENE")->required();
  command->add_option("--list", addition->list, kListHelp)->type_name("FILE");
  addition->reason = "looked at, and right, when it was added";
  command->add_option("--reason", addition->reason, "Why its limits are what they are")->type_name("TEXT");
  command->allow_extras();
  command->callback([addition, command, &chosen] {
    addition->options = command->remaining();
    chosen = [addition] {
      gl::limit_software_threads(allowed_processors());
      return golden_add(*addition);
    };
  });
}

}  // namespace

void add_golden_command(CLI::App& app, Command& chosen) {
  CLI::App* golden =
      app.add_subcommand("golden", "Render a list of cases and compare them with their expected pictures");
  golden->require_subcommand(1);
  golden->footer(
      "Examples:\n"
      "  hybridrt golden add car car.obj --size 320x240 --list mine/golden.json\n"
      "  hybridrt golden check --list mine/golden.json --junit junit.xml\n"
      "  hybridrt golden update --list mine/golden.json car");
  auto options = std::make_shared<GoldenOptions>();
  const auto add = [&](const char* name, const char* what, ExitCode (*action)(const GoldenOptions&)) {
    CLI::App* command = golden->add_subcommand(name, what);
    command->add_option("names", options->names, "Cases (default: all)")->type_name("NAME");
    command->add_option("--gl", options->gl, "Where passes run, as for render (default: as each case says)")
        ->type_name("WHERE");
    command->add_option("--device", options->device, "GL device, as 'hybridrt doctor' lists them")->type_name("ID");
    command->add_option("--list", options->list, kListHelp)->type_name("FILE");
    command->callback([options, action, &chosen] {
      chosen = [options, action] {
        gl::limit_software_threads(allowed_processors());  // before the first case starts a thread
        return action(*options);
      };
    });
    return command;
  };
  CLI::App* checking = add("check", "Compare; exit 6 when a picture differs", golden_check);
  checking->add_option("-o,--output", options->output, "Folder for pictures and report.html (default out/golden)")
      ->type_name("DIR");
  checking->add_option("--junit", options->junit, "Also write the results for a CI server")->type_name("FILE.xml");
  checking->add_flag("--enforce-time", options->enforce_time, "Fail a case that takes longer than its budget");
  add("update", "Replace the expected pictures; says what changes", golden_update);
  add_init(*golden, chosen);
  add_add(*golden, chosen);
}

}  // namespace hybridrt::cli
