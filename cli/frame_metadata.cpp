#include "cli/frame_metadata.h"

#include <fmt/format.h>

#include "cli/run_report.h"
#include "cli/version.h"
#include "core/render/fingerprint.h"
#include "core/render/picture_files.h"

namespace hybridrt::cli {
namespace {

/// On one line: a driver's name may hold anything.
std::string plain(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

}  // namespace

RunMetadata run_metadata(const RenderJob& job, const RunFacts& facts, bool layered) {
  RunMetadata run;
  run.scene_fingerprint = fingerprint(job.scene);
  run.form = facts.gl ? fmt::format("gl, {}, {}, shaders {:016x}", plain(facts.gl->renderer), plain(facts.gl->version),
                                    fingerprint(job.shaders))
                      : "cpu";
  run.form += fmt::format(", rays by {}", name_of(job.settings.accel));  // its last bits are its own
  if (layered) run.layers = fmt::format("{}", fmt::join(aov_names(job.settings.aovs), " "));
  return run;
}

ImageMetadata frame_metadata(const RunMetadata& run, const RenderJob& job, int frame) {
  ImageMetadata metadata = {
      {"hybridrt", kVersion},
      {"settings", settings_line(job.settings)},
      {"fingerprint",
       fmt::format("{:016x}", fingerprint(run.scene_fingerprint, frame_request(job, frame), job.settings))},
      {"form", run.form}};
  if (run.halfs) metadata.emplace_back("exr", "half");
  if (!run.layers.empty()) metadata.emplace_back("layers", run.layers);
  return metadata;
}

}  // namespace hybridrt::cli
