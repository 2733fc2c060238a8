#include "cli/stability/failure_sweep.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "cli/render_option_table.h"
#include "core/base/error.h"

namespace hybridrt::cli {
namespace {

Contender contender(const std::string& method, const std::string& shadows) {
  return {method + " " + shadows, {{"method", method}, {"shadows", shadows}}};
}

const std::vector<Contender> kAll = {contender("raster", "map"),  contender("hybrid", "map"),
                                     contender("hybrid", "blur"), contender("hybrid", "exact"),
                                     contender("hybrid", "rays"), {"raytrace", {{"method", "raytrace"}}}};
const std::vector<Contender> kWithMaps(kAll.begin(), kAll.begin() + 3);
const std::vector<Contender> kBlur = {kAll[2]};
const std::vector<Contender> kWithRays = {kAll[3], kAll[5]};

/// The values of 10^from, 10^(from - 1) … 10^to.
std::vector<double> powers_of_10(int from, int to, double factor = 1) {
  std::vector<double> values;
  for (int e = from;; e += from < to ? 1 : -1) {
    values.push_back(factor * std::stod(fmt::format("1e{}", e)));
    if (e == to) return values;
  }
}

std::vector<double> and_then(std::vector<double> values, std::initializer_list<double> more) {
  values.insert(values.end(), more);
  return values;
}

std::vector<FailureSweep> light_and_shadow() {
  return {
      {"light-horizon",
       "The light sinks to the horizon",
       "shadows grow without end, a map's texels with them",
       "stage",
       "elevation",
       "degrees",
       {60, 45, 30, 20, 10, 5, 2, 1, 0.3, 0.1, 0.01},
       Between::ratios,
       kAll,
       {},
       false,
       Measure::shadows},
      {"light-behind",
       "The light moves behind the eye",
       "perspective shadow maps lose their warp where light and view are parallel",
       "stage",
       "from-view",
       "degrees",
       {90, 60, 30, 10, 3, 1, 0.3, 0.1, 0.01, 0},
       Between::ratios,
       kAll,
       {},
       false,
       Measure::shadows},
      {"light-ahead",
       "The light moves before the eye",
       "the eye looks against the light: the worst of a warped map",
       "stage,eye-elevation=0.1",
       "from-view",
       "degrees",
       {90, 120, 150, 165, 172, 176, 178, 179, 179.5, 179.8},
       Between::ratios,
       kAll,
       {},
       false,
       Measure::shadows},
      {"map-size",
       "The shadow map shrinks",
       "texels are seen, and shadows with them",
       "stage",
       "shadow-map",
       "texels",
       {8192, 4096, 2048, 1024, 512, 256, 128, 64, 32},
       Between::whole,
       kWithMaps,
       {},
       false,
       Measure::shadows},
      {"kernel",
       "The blur's kernel shrinks",
       "what marks the boundary no longer reaches where the map is wrong",
       "wires,thickness=0.004",
       "blur-kernel",
       "pixels",
       {15, 13, 11, 9, 7, 5, 3, 1},
       Between::none,
       kBlur,
       {{"shadow-map", "512"}},
       false,
       Measure::shadows},
      {"thin-casters",
       "Casters get thin",
       "a caster thinner than a texel is missed by maps, and one narrower than the "
       "kernel by the blur",
       "wires",
       "thickness",
       "units",
       {0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 5e-4, 2e-4, 1e-4},
       Between::ratios,
       kAll,
       {},
       false,
       Measure::shadows},
      {"terminator",
       "The ball gets coarse",
       "facets shade themselves where a smooth ball would be lit",
       "stage,elevation=20",
       "segments",
       "segments",
       {512, 256, 128, 64, 32, 16, 8, 6},
       Between::whole,
       kAll,
       {},
       false,
       Measure::shadows},
  };
}

std::vector<FailureSweep> numbers_and_surfaces() {
  return {
      {"distance",
       "The scene moves away from the origin",
       "single precision holds 7 digits",
       "stage",
       "distance",
       "units",
       and_then({0}, {1, 10, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8}),
       Between::ratios,
       kAll,
       {},
       true},
      {"spread", "The scene gets wider than its details", "single precision holds 7 digits", "stage", "spread", "units",
       and_then({0}, {1, 10, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7}), Between::ratios, kAll},
      {"shrink",
       "The scene shrinks",
       "fixed epsilons",
       "stage",
       "scale",
       "",
       powers_of_10(0, -6),
       Between::ratios,
       kAll,
       {},
       true},
      {"grow",
       "The scene grows",
       "fixed epsilons",
       "stage",
       "scale",
       "",
       powers_of_10(0, 6),
       Between::ratios,
       kAll,
       {},
       true},
      {"slivers", "Triangles get long and narrow", "intersections of nearly degenerate triangles", "slivers", "ratio",
       "length by width", powers_of_10(0, 6), Between::ratios, kAll},
      {"grazing-view",
       "The eye sinks to the plane",
       "surfaces that are seen edge on",
       "stage",
       "eye-elevation",
       "degrees",
       {25, 10, 5, 2, 1, 0.5, 0.2, 0.1, 0.01, 0.001},
       Between::ratios,
       kAll},
      {"coplanar", "Two sheets approach", "which one is in front, and which in shadow", "sheets", "gap", "units",
       and_then(powers_of_10(-1, -9), {0}), Between::ratios, kAll},
      {"eye-plane", "The eye sinks onto a surface", "what is near is cut away, or wraps around", "eye", "above",
       "units", powers_of_10(0, -9), Between::ratios, kAll},
      {"eye-corner", "The eye moves to a corner", "what is near is cut away, or wraps around", "eye", "to-corner",
       "units", powers_of_10(0, -9), Between::ratios, kAll},
      {"eye-wall", "The eye moves to a wall", "the near plane cuts geometry", "eye", "to-wall", "units",
       powers_of_10(0, -9), Between::ratios, kAll},
      {"flicker",
       "A slow pan over wires that get thin",
       "what is seen must not change but with the eye",
       "wires",
       "thickness",
       "units",
       {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 1e-4, 1e-5},
       Between::ratios,
       kAll,
       {{"frames", "1-5"}, {"sequence", "1-3600"}},
       false,
       Measure::flicker},
  };
}

std::vector<FailureSweep> rays() {
  const OptionValues deep = {{"reflection-depth", "64"}};
  return {
      {"critical-angle",
       "The view narrows around the critical angle",
       "reflection turns total within no angle at all",
       "prism",
       "field",
       "degrees",
       {30, 10, 3, 1, 0.1, 0.01, 1e-3, 1e-4, 1e-5},
       Between::ratios,
       kWithRays,
       deep},
      {"index-above-1", "Glass becomes air, from above", "what is nearly not there must not be seen", "lens",
       "index-offset", "index - 1", and_then({0.5, 0.2}, {0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0}),
       Between::ratios, kWithRays, deep},
      {"index-below-1", "Glass becomes air, from below", "what is nearly not there must not be seen", "lens",
       "index-offset", "index - 1", and_then({-0.3, -0.2}, {-0.1, -0.01, -1e-3, -1e-4, -1e-5, -1e-6, -1e-7, -1e-8, 0}),
       Between::ratios, kWithRays, deep},
      {"mirror-depth",
       "Two mirrors, and fewer generations of rays",
       "what is left out is missing",
       "mirrors",
       "reflection-depth",
       "generations",
       {64, 32, 16, 8, 4, 2, 1, 0},
       Between::whole,
       kWithRays},
      {"eye-in-glass", "The eye in glass moves to its surface", "rays start on the surface that they should hit", "eye",
       "in-glass", "units", powers_of_10(0, -9, 0.5), Between::ratios, kWithRays, deep},
  };
}

void append(std::vector<FailureSweep>& to, std::vector<FailureSweep> more) {
  for (FailureSweep& sweep : more) to.push_back(std::move(sweep));
}

}  // namespace

bool FailureSweep::parameter_is_option() const {
  const std::vector<RenderOption> table = render_option_table();
  return std::any_of(table.begin(), table.end(), [&](const RenderOption& o) { return o.name + 2 == parameter; });
}

std::vector<FailureSweep> failure_sweeps(const std::string& scene) {
  std::vector<FailureSweep> sweeps = light_and_shadow();
  append(sweeps, numbers_and_surfaces());
  append(sweeps, rays());
  if (scene.empty()) return sweeps;
  std::set<std::string> scenes;
  for (const FailureSweep& sweep : sweeps) scenes.insert("scene:" + sweep.scene.substr(0, sweep.scene.find(',')));
  if (!scenes.contains(scene))
    throw error(ErrorKind::usage,
                "--preset stability: {} is none of its scenes; leave SCENE out for all, or take one of {}", scene,
                fmt::join(scenes, ", "));
  std::erase_if(sweeps,
                [&](const FailureSweep& sweep) { return !("scene:" + sweep.scene + ",").starts_with(scene + ","); });
  return sweeps;
}

RenderOptions options_of(const RenderOptions& base, const FailureSweep& sweep, double value,
                         const Contender& contender) {
  RenderOptions options = base;
  options.scene = "scene:" + sweep.scene;
  for (const auto& [name, text] : sweep.options) set_render_option(options, "--" + name, text);
  for (const auto& [name, text] : contender.options) set_render_option(options, "--" + name, text);
  const std::string text = fmt::format("{:.12g}", value);
  if (sweep.parameter_is_option())
    set_render_option(options, "--" + sweep.parameter, text);
  else
    options.scene += fmt::format(",{}={}", sweep.parameter, text);
  return options;
}

void require_free_options(const RenderOptions& base) {
  constexpr std::string_view kFree[] = {"--size",        "--accel",           "--threads",          "--max-memory",
                                        "--gl",          "--device",          "--require-hardware", "--shaders",
                                        "--shadow-warp", "--frames-in-flight"};
  for (const auto& [name, value] : base.given)
    if (std::find(std::begin(kFree), std::end(kFree), name) == std::end(kFree))
      throw error(ErrorKind::usage, "--preset stability sets {} itself; it takes {}", name, fmt::join(kFree, ", "));
}

}  // namespace hybridrt::cli
