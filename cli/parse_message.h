#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace hybridrt::cli {

/// One line saying what is wrong with the arguments that `app` refused, and what to do, in our words: unknown ones
/// with the nearest option of the chosen command, options given twice, without a value or with one of another kind.
std::string parse_message(const CLI::App& app, const CLI::ParseError& problem);

}  // namespace hybridrt::cli
