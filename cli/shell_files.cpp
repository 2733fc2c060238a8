#include "cli/shell_files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/version.h"

namespace hybridrt::cli {
namespace {

std::vector<const CLI::App*> subcommands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Text that roff takes as it is.
std::string roff(std::string_view text) {
  std::string out;
  for (char c : text) out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  if (out.starts_with('.') || out.starts_with('\'')) out.insert(0, "\\&");
  for (size_t at = 0; (at = out.find("\n.", at)) != out.npos; at += 2) out.replace(at, 2, "\n\\&.");
  return out;
}

/// "-o, --output PATTERN"; a positional by its name.
std::string usage_of(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += fmt::format("{}-{}", names.empty() ? "" : ", ", name);
  for (const std::string& name : option.get_lnames()) names += fmt::format("{}--{}", names.empty() ? "" : ", ", name);
  if (names.empty()) return option.get_name();
  return option.get_items_expected_max() > 0 ? names + " " + option.get_type_name() : names;
}

std::string options_as_roff(const CLI::App& app) {
  std::string out;
  for (const CLI::Option* option : app.get_options())
    out += fmt::format(".TP\n.B {}\n{}\n", roff(usage_of(*option)), roff(option->get_description()));
  return out;
}

std::string commands_as_roff(const CLI::App& app, const std::string& before) {
  std::string out;
  for (const CLI::App* command : subcommands(app)) {
    const std::string name = before + " " + command->get_name();
    out += fmt::format(".SS {}\n{}\n{}", roff(name), roff(command->get_description()), options_as_roff(*command));
    if (const std::string footer = command->get_footer(); !footer.empty())
      out += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(footer));
    out += commands_as_roff(*command, name);
  }
  return out;
}

std::string words_of(const CLI::App& app) {
  std::string words;
  for (const CLI::App* command : subcommands(app)) words += command->get_name() + " ";
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) words += "--" + name + " ";
    for (const std::string& name : option->get_snames()) words += "-" + name + " ";
  }
  if (!words.empty()) words.pop_back();
  return words;
}

/// One branch for each command, with the ones below it.
std::string cases_of(const CLI::App& app, const std::string& path) {
  std::string out = fmt::format("    '{}') words='{}' ;;\n", path, words_of(app));
  for (const CLI::App* command : subcommands(app))
    out += cases_of(*command, path.empty() ? command->get_name() : path + " " + command->get_name());
  return out;
}

}  // namespace

std::string man_page(const CLI::App& app) {
  return fmt::format(
      ".TH HYBRIDRT 1 \"\" \"hybridrt {}\" \"User Commands\"\n.SH NAME\nhybridrt \\- headless hybrid CPU\\-GPU "
      "renderer of "
      "frame sequences\n.SH SYNOPSIS\n.B hybridrt\n.I COMMAND\n[options]\n.SH OPTIONS\n{}.SH COMMANDS\n{}.SH EXIT "
      "STATUS\n"
      "0 ok, 1 some settings of a sweep failed, 2 usage, 3 scene, camera or other input, 4 no usable GL or device, 5 "
      "output could not be written,\n6 "
      "images "
      "differ, 70 internal error, 130 or 143 stopped by a signal.\n",
      kVersion, options_as_roff(app), commands_as_roff(app, "hybridrt"));
}

std::string bash_completion(const CLI::App& app) {
  return fmt::format(R"(# bash completion for hybridrt
_hybridrt() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} path= i words=
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${{COMP_WORDS[i]}} == -* ]] && break
    case "$path" in '' | golden) path="${{path:+$path }}${{COMP_WORDS[i]}}" ;; esac
  done
  case "$path" in
{}  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
  [[ ${{#COMPREPLY[@]}} -eq 0 ]] && COMPREPLY=($(compgen -f -- "$word"))
}}
complete -o filenames -F _hybridrt hybridrt
)",
                     cases_of(app, ""));
}

}  // namespace hybridrt::cli
