#include "cli/help_formatter.h"

#include <algorithm>

namespace hybridrt::cli {
namespace {

constexpr size_t kWidth = 100, kSecondColumn = 27;

/// Takes as many words off `text` as fit into `room`, at least one.
std::string_view take_line(std::string_view& text, size_t room) {
  size_t end = text.size();
  if (end > room) {
    end = text.rfind(' ', room);
    if (end == text.npos) end = std::min(text.find(' '), text.size());
  }
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

}  // namespace

std::string two_columns(std::string_view left, std::string_view text) {
  std::string out(left);
  // A long name has a line of its own.
  out += left.size() < kSecondColumn ? std::string(kSecondColumn - left.size(), ' ')
                                     : "\n" + std::string(kSecondColumn, ' ');
  do {
    if (out.back() == '\n') out.append(kSecondColumn, ' ');
    out.append(take_line(text, kWidth - kSecondColumn)).append("\n");
  } while (!text.empty());
  return out;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  const std::string left = "  " + make_option_name(option, is_positional) + make_option_opts(option);
  return two_columns(left, make_option_desc(option));
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  return option->get_items_expected_max() == 0 ? "" : " " + option->get_type_name();
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return two_columns("  " + command->get_name(), command->get_description());
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  const std::string description = app->get_description();
  std::string_view text = description;
  std::string out;
  while (!text.empty()) out.append(take_line(text, kWidth)).append("\n");
  return out;
}

}  // namespace hybridrt::cli
