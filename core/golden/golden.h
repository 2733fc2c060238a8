#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/named.h"
#include "core/image/compare.h"

namespace hybridrt {

/// Where passes ran. Rounding differs between classes, and within the last one.
enum class RendererClass { cpu, software_gl, hardware_gl };
inline constexpr Named<RendererClass> kRendererClasses[] = {{"cpu", RendererClass::cpu},
                                                            {"software_gl", RendererClass::software_gl},
                                                            {"hardware_gl", RendererClass::hardware_gl}};

/// Pictures that must stay as they are.
struct GoldenCase {
  std::string name;                     ///< expected pictures: see GoldenList::expected
  std::string scene;                    ///< path (resolved against the list) or scene:…
  std::vector<std::string> options;     ///< options of `render`
  std::array<CompareLimits, 3> limits;  ///< by RendererClass
  std::string reason;                   ///< why these limits
  std::optional<double> budget;         ///< its time, at most, as a multiple of the calibration's

  const CompareLimits& limits_for(RendererClass where) const { return limits[static_cast<size_t>(where)]; }
};

struct GoldenList {
  std::filesystem::path file, folder;
  std::vector<GoldenCase> cases;

  /// Beside the list: NAME.png, or NAME.0007.png for frame 7 of a case with several.
  std::filesystem::path expected(const std::string& picture) const { return folder / (picture + ".png"); }
};

/// A case's picture: its name, and the frame's number if it has several.
std::string golden_picture_name(const GoldenCase& golden, int frame, bool has_several);

/// Scene paths are resolved against the list's folder, then against the folder above it. Throws Error(input) for what
/// is no list; all that is wrong with its cases is told at once, each with the file and the line where the case begins.
GoldenList read_golden_list(const std::filesystem::path& list);

/// Keeps the named cases, in the list's order; all if `names` is empty. Throws Error(usage) for names that are not in
/// the list.
void keep_cases(GoldenList& list, std::span<const std::string> names);

/// The list's text with one more case at its end. `text`: the list's; empty for a new one. `scene` as it will be read.
/// Throws Error(input) if it is none, Error(usage) if it has a case of that name.
std::string with_golden_case(const std::string& text, const std::filesystem::path& list, const std::string& name,
                             const std::string& scene, const std::vector<std::string>& options,
                             const std::string& reason);

/// How long a case took, as a multiple of the calibration's time.
struct GoldenTime {
  double seconds = 0, calibrations = 0;
  std::optional<double> budget;
  bool is_over() const { return budget && calibrations > *budget; }
};

/// The result of one picture, or of a case that has none. Paths are empty where there is no such file.
struct GoldenResult {
  std::string name;     ///< of the picture, or of the case
  std::string command;  ///< scene and options
  std::string reason;   ///< of the limits
  CompareLimits limits;
  CompareResult compared;
  std::string failure;     ///< why it could not be compared at all
  bool is_broken = false;  ///< the case could not even be rendered: the list's fault, not the picture's
  std::string where;       ///< GL renderer, or that the CPU ran all passes
  std::filesystem::path actual, expected, difference;
  GoldenTime time;  ///< of its case
  bool enforce_time = false;

  bool passed() const { return failure.empty() && compared.same && !(enforce_time && time.is_over()); }
  std::string verdict() const;  ///< one line
};

}  // namespace hybridrt
