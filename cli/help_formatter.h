#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

namespace hybridrt::cli {

/// Help texts in two columns, no line wider than 100. Commands under an app inherit it.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_description(const CLI::App* app) const override;
};

/// `left`, and from the second column on `text`, wrapped between words; a newline behind it.
std::string two_columns(std::string_view left, std::string_view text);

}  // namespace hybridrt::cli
