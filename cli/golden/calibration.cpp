#include "cli/golden/calibration.h"

#include <algorithm>
#include <array>

#include "cli/golden/golden_case.h"
#include "core/base/timing.h"

namespace hybridrt::cli {

double calibration_seconds() {
  GoldenCase fixed;
  fixed.name = "calibration";
  fixed.scene = "scene:spheres,triangles=20000";
  fixed.options = {"--method", "raytrace", "--accel", "kdtree", "--size", "320x240", "--frames", "1", "--gl", "off"};
  std::array<double, 5> seconds;
  for (double& taken : seconds) {
    const Stopwatch stopwatch;
    const CaseJob job = make_case_job(fixed, {}, {});
    render_case(fixed, job, [](const std::string&, const Image&) {});
    taken = stopwatch.elapsed_ms() * 1e-3;
  }
  std::ranges::sort(seconds);
  return seconds[seconds.size() / 2];
}

}  // namespace hybridrt::cli
