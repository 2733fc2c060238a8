#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hybridrt {

/// Where a frame's picture goes. `####` (any number of '#', file name only: folders may be called "c#"), `%04d` and
/// `{frame:04}` stand for the frame number with at least that many digits, `{frame}` (in folders too) for the bare
/// number; longer numbers are never cut.
struct OutputPattern {
  std::string folder;  ///< up to and including the last '/', or empty; may hold {frame}
  std::string name;    ///< the file name
};

/// Several frames without a placeholder get the number appended: `name.png` becomes `name.####.png`. One frame without
/// a placeholder keeps its name. Throws Error (usage) if there is no file name, for a `{frame…}` of any other
/// form, and if several frames have no mark but one that we do not know (`$F4`, `@@@@`).
OutputPattern parse_output_pattern(const std::string& text, bool several_frames);

/// The deepest folder that holds all frames, "." for the working directory: `q` of `q/{frame}/a.png`.
std::filesystem::path common_folder(const OutputPattern& pattern);

/// The part below it, with '#' for each frame number, however many digits it has; equal for patterns that may give the
/// same paths: `#/a.png`.
std::string name_below(const OutputPattern& pattern);

/// The file name without its frame number and extension: `car` of `car.####.png`. "frames" if nothing is left.
std::string stem_of(const OutputPattern& pattern);

/// The path of one frame, or of one of its AOVs, whose name goes before the frame number, or before the
/// extension where the name has none: `name.####.png` -> `name.depth.0007.png`.
std::filesystem::path output_path(const OutputPattern& pattern, int64_t frame, std::string_view aov = {});

}  // namespace hybridrt
