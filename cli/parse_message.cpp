#include "cli/parse_message.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <numeric>
#include <string_view>

namespace hybridrt::cli {
namespace {

/// Levenshtein distance.
size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replace = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replace}));
    }
  }
  return row[b.size()];
}

void collect_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
}

std::string unknown_argument_message(const CLI::App& app) {
  const std::vector<std::string> extras = app.remaining(/*recurse=*/true);
  const std::string unknown = extras.empty() ? "?" : extras.front();
  const std::string name = unknown.substr(0, unknown.find('='));

  std::vector<std::string> known;
  std::string command = "hybridrt";
  for (const CLI::App* chosen : app.get_subcommands()) {
    command += " " + chosen->get_name();
    collect_names(*chosen, known);
  }
  if (app.get_subcommands().empty())
    for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; }))
      known.push_back(subcommand->get_name());

  const std::string* nearest = nullptr;
  for (const std::string& candidate : known)
    if (!nearest || edit_distance(candidate, name) < edit_distance(*nearest, name)) nearest = &candidate;
  const char* what = unknown.starts_with("-") ? "option" : "argument";
  if (nearest && edit_distance(*nearest, name) <= 1 + name.size() / 2)
    return fmt::format("unknown {} {}; did you mean {}? See '{} --help'", what, unknown, *nearest, command);
  return fmt::format("unknown {} {}; see '{} --help'", what, unknown, command);
}

/// The option of `app` or of a chosen command that the parser's message names (after `before`).
const CLI::Option* option_in(const CLI::App& app, std::string_view message, std::string_view before) {
  if (!message.starts_with(before)) return nullptr;
  message.remove_prefix(before.size());
  const std::string name(message.substr(0, message.find_first_of(": =")));
  if (const CLI::Option* option = app.get_option_no_throw(name)) return option;
  for (const CLI::App* chosen : app.get_subcommands())
    if (const CLI::Option* option = option_in(*chosen, message, "")) return option;
  return nullptr;
}

/// `--size WxH`
std::string usage_of(const CLI::Option& option) {
  const std::string type = option.get_items_expected_max() > 0 ? " " + option.get_type_name() : "";
  return option.get_name() + type;
}

}  // namespace

std::string parse_message(const CLI::App& app, const CLI::ParseError& problem) {
  if (dynamic_cast<const CLI::ExtrasError*>(&problem)) return unknown_argument_message(app);
  const std::string_view message = problem.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&problem))
    if (const CLI::Option* option = option_in(app, message, "")) {
      const std::vector<std::string>& values = option->results();
      if (values.size() > 1)
        return fmt::format("{} is given {} times ({}); give it once", option->get_name(), values.size(),
                           fmt::join(values, ", "));
      return fmt::format("{} has no value; write {}", option->get_name(), usage_of(*option));
    }
  if (dynamic_cast<const CLI::ConversionError*>(&problem))
    if (const CLI::Option* option = option_in(app, message, "Could not convert: "))
      return fmt::format("{} {}: that cannot be read; write {}", option->get_name(), fmt::join(option->results(), " "),
                         usage_of(*option));
  if (problem.get_exit_code() == 0) return "--help explains the command line and cannot be given here; leave it out";
  return fmt::format("{}; see 'hybridrt --help'", message);
}

}  // namespace hybridrt::cli
