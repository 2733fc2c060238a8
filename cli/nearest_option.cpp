#include "cli/nearest_option.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <numeric>

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

}  // namespace

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

}  // namespace hybridrt::cli
