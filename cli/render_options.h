#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/named.h"
#include "core/gl/device_probe.h"
#include "core/load/mesh_format.h"
#include "core/load/scene_source.h"
#include "core/render/frame_spec.h"
#include "core/render/settings.h"
#include "core/scene/up_axis.h"

namespace CLI {
class App;
}

namespace hybridrt::cli {

/// Where the passes that the paper draws on a GPU run. automatic: on one if there is one, else on the CPU.
enum class GlUse { automatic, egl, osmesa, off };
inline constexpr Named<GlUse> kGlUses[] = {
    {"auto", GlUse::automatic}, {"egl", GlUse::egl}, {"osmesa", GlUse::osmesa}, {"off", GlUse::off}};

/// The options of a render, with their defaults. Points and directions are in the axes of the scene's files.
struct RenderOptions {
  std::string scene;
  RenderSettings settings;            ///< complete after finished_settings()
  std::optional<ShadowMode> shadows;  ///< default: the method's
  std::string frames = "1";
  std::optional<FrameRange> sequence;        ///< default: from the first to the last frame
  std::optional<UpAxis> up_axis;             ///< default: what the scene says
  std::optional<vec3> background;            ///< linear; default: what the scene says
  std::optional<MeshFormat> input_format;    ///< of a scene from standard input
  std::optional<double> reflection_percent;  ///< share of the triangles made mirrors; default: as the scene is
  bool linear_colors = false;                ///< the meshes' colours are linear, not sRGB
  bool ground = false;                       ///< a floor under the scene
  std::string config;                        ///< JSON file with more options
  std::string camera;                        ///< camera path file
  std::optional<dvec3> eye, target, up, light;
  bool light_follows_camera = false;
  std::optional<double> fov_y_rad;     ///< default: the camera's own
  std::optional<int> threads;          ///< default: all allowed processors
  std::optional<uint64_t> most_bytes;  ///< memory limit; default: what the machine and the cgroup have
  uint64_t sheet_bytes = 0;            ///< of it, what the contact sheet takes
  GlUse gl_use = GlUse::automatic;
  gl::ContextRequest gl;
  std::string shaders;  ///< folder; empty: the built-in ones
  /// What is known about GL devices; copies share it, so that a run tries each once. Empty: nothing is going to be
  /// drawn, and none is tried.
  std::shared_ptr<gl::Probes> probes = std::make_shared<gl::Probes>();

  /// Names (with dashes) and values of the options that were given, in order; filled by parsing.
  std::vector<std::pair<std::string, std::string>> given;
};

/// Adds the options of render_option_table.h: what decides pictures and how they are made, not where they go.
void add_render_options(CLI::App& app, RenderOptions& options);

/// What the options' scene is; "-" is read from standard input now. Throws as parse_scene_source() and
/// read_scene_from_standard_input(), Error(usage) unless --input-format goes with "-".
SceneSource scene_source_of(const RenderOptions& options);

/// Sets an option as the command line would. Throws Error(usage) for a value that it does not take; `name`, with
/// dashes, must be one of the table.
void set_render_option(RenderOptions& options, const std::string& name, const std::string& value);

/// The options with the source's `settings` applied, and over them those of --config; the command line takes
/// precedence. Throws Error(input), naming the
/// scene, for settings that are not render options or have a value that the option does not take.
RenderOptions with_scene_settings(const RenderOptions& options, const SceneSource& source);

/// The settings of every frame. Throws Error(usage) for options that contradict each other.
RenderSettings finished_settings(const RenderOptions& options);

}  // namespace hybridrt::cli
