#include "cli/version.h"

#include <CLI/CLI.hpp>
#include <embree3/rtcore.h>
#include <fmt/core.h>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "core/gl/device_probe.h"
#include "core/image_io/encode_image.h"

namespace hybridrt::cli {

nlohmann::ordered_json library_versions() {
  nlohmann::ordered_json versions = {
      {"embree", RTC_VERSION_STRING},
      {"glm", fmt::format("{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"cli11", CLI11_VERSION}};
  for (const auto& [library, version] : image_library_versions()) versions[library] = version;
  return versions;
}

namespace {

nlohmann::ordered_json gl_renderer() {
  const gl::ProbeResult found = gl::probe({}, gl::ProbeScope::first);
  if (found.usable.empty()) return nullptr;
  return found.usable.front().renderer + ", OpenGL " + found.usable.front().version;
}

}  // namespace

ExitCode print_version(bool as_json) {
  nlohmann::ordered_json facts = {
      {"version", kVersion}, {"commit", kCommit}, {"compiler", kCompiler}, {"libraries", library_versions()}};
  if (as_json) {
    facts["gl_renderer"] = gl_renderer();
    fmt::print("{}\n", facts.dump(2));
    return ExitCode::ok;
  }
  fmt::print("hybridrt {} ({}), built by {}\n", kVersion, kCommit, kCompiler);
  for (const auto& [library, version] : facts["libraries"].items())
    fmt::print("{} {}\n", library, version.get<std::string>());
  return ExitCode::ok;
}

}  // namespace hybridrt::cli
