#pragma once

#include <filesystem>
#include <string>

#include "cli/render_options.h"
#include "core/base/file_claims.h"
#include "core/base/warnings.h"
#include "core/render/output_pattern.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// What can be said about a render's files.
struct OutputOptions {
  std::string pattern, timings, contact_sheet;
  bool json = false, quiet = false, verbose = false;
};

/// Where a run's files go.
struct OutputPaths {
  OutputPattern pattern;
  std::string timings;  ///< may be "-"
  std::filesystem::path report;
};

/// Settles all of that before anything is rendered: makes the folders, tries each file, and claims them all, so that
/// two runs at once do not write the same ones. When only the timings or the report would be the same, theirs get the
/// range of the frames in their names, with a warning. Throws Error: usage for names and formats that cannot be,
/// output for what cannot be written or is being written by another run.
OutputPaths prepare_output(const OutputOptions& options, const RenderOptions& render, const RenderJob& job,
                           FileClaims& claims, Warnings& warnings);

}  // namespace hybridrt::cli
