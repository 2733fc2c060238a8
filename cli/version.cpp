#include "cli/version.h"

#include <embree3/rtcore.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "core/image_io/encode_image.h"

namespace hybridrt::cli {

nlohmann::ordered_json library_versions() {
  return {{"embree", RTC_VERSION_STRING},
          {"openimageio", image_library_version()},
          {"glm", fmt::format("{}.{}.{}", GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)},
          {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
          {"cli11", CLI11_VERSION}};
}

}  // namespace hybridrt::cli
