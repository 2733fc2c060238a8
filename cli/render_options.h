#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/warnings.h"
#include "core/load/load_watch.h"
#include "core/render/render_job.h"

namespace CLI {
class App;
}

namespace hybridrt::cli {

/// What can be said about a render on the command line, as text or number, with the defaults.
struct RenderOptions {
  std::string scene;
  std::string frames = "1", sequence;
  std::string up_axis;                 ///< "y" or "z"; empty: what the scene says
  std::string camera;                  ///< camera path file
  std::string eye, target, up, light;  ///< X,Y,Z, in the axes of the scene's files
  std::string light_follows;           ///< empty or "camera"
  std::optional<double> fov_deg;       ///< default 45, or what the camera path says
  std::string size = "1024x768", crop;
  Method method = Method::hybrid;
  std::string shadows;  ///< empty: the method's default
  ShadowWarp shadow_warp = ShadowWarp::lispsm;
  int blur_kernel = 5, shadow_map = 2048, reflection_depth = 4, samples = 1;
  std::optional<int> threads;  ///< default: all allowed processors
  std::string max_memory;      ///< SIZE or "none"; empty: what the machine and the cgroup have
  Accel accel = Accel::embree;
  int frames_in_flight = 2;
  gl::Binding gl = gl::Binding::any;
  std::string device, shaders;
  bool require_hardware = false;
  std::string aovs;

  /// Names (with dashes) and values of the options that were given, in order; filled by parsing.
  std::vector<std::pair<std::string, std::string>> given;
};

/// Adds the options that decide pictures and how they are made (not where they go).
void add_render_options(CLI::App& app, RenderOptions& options);

/// The settings of every frame. Throws Error(usage) for values that cannot be.
RenderSettings make_settings(const RenderOptions& options);

/// Threads of a run, what a software GL starts of its own included. Throws Error(usage) for numbers that cannot be.
int thread_count(const RenderOptions& options);

/// The options after the `settings` of a scene JSON; what was given on the command line wins. Other scenes say
/// nothing. Throws Error(input) naming the file for settings that no render option is or takes.
RenderOptions with_scene_settings(const RenderOptions& options);

/// Reads the scene and turns the options, as with_scene_settings() has them, into a job. Throws Error(usage) for values
/// that cannot be, Error(input) for the scene. `progress` is told how far reading it is.
RenderJob make_render_job(const RenderOptions& options, Warnings& warnings, LoadProgress* progress = nullptr);

}  // namespace hybridrt::cli
