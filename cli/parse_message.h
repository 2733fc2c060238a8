#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace hybridrt::cli {

/// One line saying what is wrong with the arguments that `app` refused, and what to do: unknown options, with the
/// nearest known one, and options given twice, without a value or with a value of the wrong kind.
std::string parse_message(const CLI::App& app, const CLI::ParseError& problem);

}  // namespace hybridrt::cli
