#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/warnings.h"
#include "core/mesh/topology.h"
#include "core/render/memory_estimate.h"
#include "core/render/plan_notes.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// All that `inspect` reports about a scene and the first frame.
struct Inspection {
  std::string scene;  ///< the SCENE argument
  RenderJob job;
  Warnings warnings;
  FramePlan plan;
  std::vector<StepNote> steps;
  MemoryEstimate memory;
  std::vector<size_t> material_triangles;  ///< number of triangles of each material
};

/// Aligned text for people, in lines of about 100 columns.
std::string inspection_text(const Inspection& inspection);

/// The same as one object; dump() must replace bytes of names that are not UTF-8.
nlohmann::ordered_json inspection_json(const Inspection& inspection);

/// A material's effect on light in one word: matte, highlight, mirror, glass or see-through.
std::string_view kind_of(const Material& material);

/// The numbers of the `most` components with the most triangles, largest first.
std::vector<uint32_t> largest_components(const Topology& topology, size_t most);

std::string_view name_of(Winding winding);

}  // namespace hybridrt::cli
