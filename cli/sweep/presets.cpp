#include "cli/sweep/presets.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace hybridrt::cli {
namespace {

/// 1, 2, 4 and so on, and all.
std::string thread_counts(int processors) {
  std::string counts;
  for (int n = 1; n < processors; n *= 2) counts += fmt::format("{},", n);
  return counts + fmt::format("{}", processors);
}

}  // namespace

PresetOptions preset_options(Preset preset, const std::string& scene, int processors) {
  switch (preset) {
    case Preset::paper:  // figure 6: pass times over the reflective share, one frame after the other
      return {{"reflection-percent=0:100:10"},
              {{"--shadows", "blur"}, {"--blur-kernel", "5"}, {"--reflection-depth", "1"}, {"--frames-in-flight", "1"}},
              1};
    case Preset::pareto:
      return {{"method=hybrid,raytrace,raster", "shadows=none,map,blur,exact,rays", "samples=1,4"}, {}, 64};
    case Preset::scaling:  // figure 7
      return {{"method=hybrid,raytrace", "threads=" + thread_counts(processors)}, {}, 0};
    case Preset::growth:
      if (!scene.starts_with("scene:"))
        throw error(ErrorKind::usage, "--preset growth: {} has one size only; take scene:chess or another made scene",
                    scene);
      return {{"triangles=10k,100k,1M,5M,20M", "method=hybrid,raytrace"}, {}, 0, /*memory=*/true};
    case Preset::pixels:
      return {
          {"size=640x480,1280x960,2560x1440,3840x2160,7680x4320", "method=hybrid,raytrace"}, {}, 0, /*memory=*/true};
    case Preset::stability: break;
  }
  return {};
}

}  // namespace hybridrt::cli
