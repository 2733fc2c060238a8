#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/run_report.h"
#include "cli/version.h"
#include "core/base/parallel.h"
#include "core/gl/device_probe.h"

namespace hybridrt::cli {
namespace {

using json = nlohmann::ordered_json;

json describe(const gl::ContextInfo& info) {
  return {{"id", info.device},
          {"binding", info.binding},
          {"renderer", info.renderer},
          {"vendor", info.vendor},
          {"version", info.version},
          {"hardware", !info.software},
          {"max_texture_px", info.max_texture_px},
          {"max_buffer_texels", info.max_buffer_texels}};
}

ExitCode doctor(bool as_json) {
  const auto [usable, failed] = gl::probe({}, gl::ProbeScope::all);
  const bool has_gpu = std::any_of(usable.begin(), usable.end(), [](const gl::ContextInfo& i) { return !i.software; });

  json report = {{"version", kVersion},
                 {"commit", kCommit},
                 {"compiler", kCompiler},
                 {"libraries", library_versions()},
                 {"processor", processor_name()},
                 {"threads", allowed_processors()},
                 {"gpu", has_gpu},
                 {"devices", json::array()},
                 {"unusable", json::array()}};
  for (const gl::ContextInfo& info : usable) report["devices"].push_back(describe(info));
  for (const gl::DeviceInfo& device : failed)
    report["unusable"].push_back({{"id", device.id}, {"problem", device.problem}});

  if (as_json) {
    fmt::print("{}\n", report.dump(2));
  } else {
    fmt::print("hybridrt {} ({}), {}\nprocessor {}, {} threads allowed\n\n", kVersion, kCommit, kCompiler,
               processor_name(), allowed_processors());
    for (const gl::ContextInfo& info : usable)
      fmt::print("{} {:<12} {:<15} {} | OpenGL {} | textures up to {} px\n", &info == &usable.front() ? "*" : " ",
                 info.device, info.binding, info.renderer, info.version, info.max_texture_px);
    for (const gl::DeviceInfo& device : failed) fmt::print("- {:<12} unusable: {}\n", device.id, device.problem);
    if (!usable.empty())
      fmt::print("\n{}\n", has_gpu ? "* is used unless --gl or --device says otherwise"
                                   : "no GPU: all passes run on the CPU; --gl egl or osmesa and --device use *");
    else
      fmt::print("\nno usable OpenGL 4.5: all passes run on the CPU\n");
  }
  return usable.empty() ? ExitCode::device : ExitCode::ok;
}

}  // namespace

void add_doctor_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("doctor", "List GL devices and drivers, the chosen one, versions, threads");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "As one JSON object");
  command->footer(
      "Examples:\n"
      "  hybridrt doctor\n"
      "  hybridrt doctor --json | jq .devices");
  command->callback([as_json, &chosen] { chosen = [as_json] { return doctor(*as_json); }; });
}

}  // namespace hybridrt::cli
