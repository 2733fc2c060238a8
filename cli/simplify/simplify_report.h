#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/simplify/compare_frames.h"
#include "core/simplify/simplify.h"

namespace hybridrt::cli {

/// What simplify has done, and how much it shows.
struct SimplifyReport {
  std::string scene, output, materials;  ///< as given, and the files written
  double max_error_px = 0;
  size_t triangles_before = 0, triangles_after = 0;
  size_t triangles_unseen = 0;                ///< of those that simplifying left, left out as no frame sees them
  std::optional<uint64_t> bytes_before;       ///< of the meshes and materials read; nothing for a made scene
  uint64_t bytes_after = 0;                   ///< of the OBJ and MTL written
  double least_bound = 0, largest_bound = 0;  ///< over the triangles, scene units
  SurfaceDistance distance;
  int rounds = 0;
  std::vector<FrameDifference> frames;
};

nlohmann::ordered_json report_json(const SimplifyReport& report);
std::string report_text(const SimplifyReport& report);

}  // namespace hybridrt::cli
