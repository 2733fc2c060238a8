#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace hybridrt::cli {

/// Formats help in two columns, at most 100 wide. Commands of an app inherit it.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_description(const CLI::App* app) const override;
};

/// `left`, then `text` from the second column on, wrapped between words and ended by a newline.
std::string two_columns(std::string_view left, std::string_view text);

}  // namespace hybridrt::cli
