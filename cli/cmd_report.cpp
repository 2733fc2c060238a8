#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/sweep/charts.h"
#include "core/base/error.h"

namespace hybridrt::cli {
namespace {

ExitCode report(const std::string& folder) {
  if (!std::filesystem::exists(std::filesystem::path(folder) / "sweep.csv"))
    throw error(ErrorKind::input, "{}: holds no sweep.csv; name the folder that 'hybridrt sweep -o' wrote", folder);
  return draw_charts(folder);
}

}  // namespace

void add_report_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("report", "Draw a sweep's charts and report again from its rows");
  auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "The sweep's folder")->required();
  command->callback([folder, &chosen] { chosen = [folder] { return report(*folder); }; });
}

}  // namespace hybridrt::cli
