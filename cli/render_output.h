#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/picture_stream.h"
#include "core/base/file_claims.h"
#include "core/base/named.h"
#include "core/base/run_files.h"
#include "core/base/warnings.h"
#include "core/image_io/encode_options.h"
#include "core/image_io/video_frame.h"
#include "core/load/scene_source.h"
#include "core/render/output_pattern.h"
#include "core/render/render_job.h"

namespace hybridrt::cli {

/// What becomes of pictures that are there already.
enum class Existing { overwrite, resume, refuse };
inline constexpr Named<Existing> kExisting[] = {
    {"overwrite", Existing::overwrite}, {"resume", Existing::resume}, {"refuse", Existing::refuse}};

/// The options about a render's files.
struct OutputOptions {
  std::string pattern, timings, contact_sheet;
  Existing existing = Existing::overwrite;
  bool json = false, quiet = false, verbose = false;
  Compression compression = Compression::fast;
  std::optional<ExrNumbers> exr;     ///< default: float
  std::optional<VideoFormat> video;  ///< into a pipe; default: y4m for several frames, PNG for one
  std::optional<FrameRate> rate;     ///< default: 25
  bool is_part = false;              ///< of a longer --sequence: tables carry the frames
};

/// How the pictures are encoded.
inline EncodeOptions encode_options(const OutputOptions& options) {
  return {options.compression, options.exr.value_or(ExrNumbers::single)};
}

/// Where a run's files go.
struct OutputPaths {
  /// If it has a name, it takes all pictures; then `pattern` is empty, and tables are written only where asked for.
  StreamTarget stream;
  OutputPattern pattern;
  std::string timings;           ///< may be "-"; empty: none
  std::filesystem::path report;  ///< empty: none
  std::string part;              ///< the frames in the tables' names (name_part_of()); empty: the whole sequence
};

/// Decides the paths before anything is rendered: makes the folders, tests that each file can be written, and claims
/// them all, so that no two runs write the same files. If only the timings or the report would clash, this run's get
/// the range of its frames in their names, with a warning. `files`: what the run reads; its outputs are added. Throws
/// Error(usage) for impossible names and formats and for files that are read or named twice, Error(output) for what
/// cannot be written or is being written by another run.
OutputPaths prepare_output(const OutputOptions& options, const SceneSource& source, const RenderJob& job,
                           RunFiles& files, FileClaims& claims, Warnings& warnings);

}  // namespace hybridrt::cli
