#include "cli/render_option_table.h"

#include <fmt/format.h>

#include "cli/option_values.h"
#include "core/load/spooled_scene.h"

namespace hybridrt::cli {
namespace {

enum class LightFollows { camera };
constexpr Named<LightFollows> kLightFollows[] = {{"camera", LightFollows::camera}};
enum class MeshColors { srgb, linear };
constexpr Named<MeshColors> kMeshColors[] = {{"srgb", MeshColors::srgb}, {"linear", MeshColors::linear}};

using Options = RenderOptions;
using Text = const std::string&;

/// An option whose value is stored as text.
RenderOption text(const char* name, const char* value, const char* group, const char* help,
                  std::string Options::*member) {
  return {name, value, group, help, [member](Options& o, Text t) { o.*member = t; }};
}

/// An option for a whole number in the settings.
RenderOption number(const char* name, const char* value, const char* group, const char* help,
                    int RenderSettings::*member, int lowest, int highest) {
  return {name, value, group, fmt::format("{}, {} to {} (default {})", help, lowest, highest, RenderSettings().*member),
          [=](Options& o, Text t) { o.settings.*member = parse_whole(name, t, lowest, highest); }};
}

/// An option whose value is one of a table's names.
template <typename Value, size_t N>
RenderOption choice(const char* name, const char* value, const char* group, const std::string& help,
                    Value RenderSettings::*member, const Named<Value> (&table)[N]) {
  return {name, value, group, fmt::format("{} (default {})", help, name_in(table, RenderSettings().*member)),
          [=, &table](Options& o, Text t) { o.settings.*member = parse_name(name, table, t); }};
}

void append(std::vector<RenderOption>& table, std::vector<RenderOption> more, Affects affects) {
  for (RenderOption& option : more) {
    option.affects = affects;
    table.push_back(std::move(option));
  }
}

std::vector<RenderOption> scene() {
  const char* group = "Scene";
  return {
      {"--up-axis", "AXIS", group,
       fmt::format("Which axis of the scene's files points up: {} (default {}). Cameras and lights are given in the "
                   "files' axes too",
                   names_in(kUpAxes), name_in(kUpAxes, UpAxis())),
       [](Options& o, Text t) { o.up_axis = parse_name("--up-axis", kUpAxes, t); }},
      {"--mesh-colors", "SPACE", group,
       fmt::format("What the colours of vertices and faces in mesh files are: {} (default {})", names_in(kMeshColors),
                   name_in(kMeshColors, MeshColors())),
       [](Options& o, Text t) { o.linear_colors = parse_name("--mesh-colors", kMeshColors, t) == MeshColors::linear; }},
      {"--ground", "", group, "Put a floor under the scene",
       [](Options& o, Text t) { o.ground = parse_flag("--ground", t); }},
      {"--reflection-percent", "P", group,
       "Make P % of the triangles mirrors of reflectivity 0.5, by whole components or patches, chosen by a fixed "
       "shuffle; the scene's own mirrors are unset first (default: as the scene is)",
       [](Options& o, Text t) { o.reflection_percent = parse_percent("--reflection-percent", t); }},
  };
}

std::vector<RenderOption> frames() {
  const char* group = "Frames";
  return {
      {"--input-format", "F", "Scene",
       fmt::format("What a SCENE of - (standard input) is: {}", names_in(kMeshFormatNames)),
       [](Options& o, Text t) { o.input_format = parse_name("--input-format", kMeshFormatNames, t); }},
      {"--frames", "SPEC", group,
       fmt::format("100 (frames 1-100), 1-100, 1-100:5, 1-10,20,30-40 (default {})", Options().frames),
       [](Options& o, Text t) { o.frames = t; }},
      {"--sequence", "A-B", group, "The sequence that the frames belong to (default: first to last frame)",
       [](Options& o, Text t) { o.sequence = parse_sequence(t); }},
      {"--aov", "LIST", group,
       "Also write any of " + names_in(kAovs) + " (as separate files; as layers of an .exr), separated by commas",
       [](Options& o, Text t) { o.settings.aovs = parse_aovs("--aov", t); }},
  };
}

std::vector<RenderOption> camera_and_light() {
  const char* group = "Camera and light";
  const double fov_deg = Camera().fov_y_rad * 180 / kPi;
  return {
      text("--camera", "FILE", group, "Camera path: keyframes or an orbit, as JSON", &Options::camera),
      {"--eye", "X,Y,Z", group, "Still camera: its position (default: an orbit)",
       [](Options& o, Text t) { o.eye = parse_vector("--eye", t); }},
      {"--target", "X,Y,Z", group, "Still camera: what it looks at (default: the scene's middle)",
       [](Options& o, Text t) { o.target = parse_vector("--target", t); }},
      {"--up", "X,Y,Z", group, "Still camera: which way is up (default 0,1,0)",
       [](Options& o, Text t) { o.up = parse_direction("--up", t); }},
      {"--fov", "DEG", group, fmt::format("Vertical field of view, replaces a camera path's (default {:g})", fov_deg),
       [](Options& o, Text t) { o.fov_y_rad = parse_fov("--fov", t); }},
      {"--light", "X,Y,Z", group,
       "Direction toward the light, any length (default: from above, left of and behind the first camera); replaces "
       "all lights of the scene and of a camera path",
       [](Options& o, Text t) { o.light = parse_direction("--light", t); }},
      {"--light-follows", "WHAT", group,
       names_in(kLightFollows) + ": the lights keep their places as seen from the camera (turntables)",
       [](Options& o, Text t) {
         o.light_follows_camera = parse_name("--light-follows", kLightFollows, t) == LightFollows::camera;
       }},
  };
}

std::vector<RenderOption> picture() {
  const char* group = "Picture";
  const RenderSettings defaults;
  return {
      {"--size", "WxH", group, fmt::format("Pixels (default {}x{})", defaults.width_px, defaults.height_px),
       [](Options& o, Text t) { parse_size("--size", t, o.settings); }},
      {"--crop", "X,Y,W,H", group, "Render this part of the frame only",
       [](Options& o, Text t) { o.settings.crop = parse_crop("--crop", t); }},
      {"--background", "R,G,B", group,
       "Colour where nothing is seen, linear; replaces the scene's (default a blue grey)",
       [](Options& o, Text t) { o.background = parse_color("--background", t); }},
      {"--alpha", "", group, "A fourth channel: coverage (PNG, TIFF: colours as they are; EXR: times coverage)",
       [](Options& o, Text t) { o.settings.alpha = parse_flag("--alpha", t); }},
  };
}

std::vector<RenderOption> method() {
  const char* group = "Method";
  return {
      choice("--method", "M", group, names_in(kMethods), &RenderSettings::method, kMethods),
      {"--shadows", "S", group,
       fmt::format("{} (default {}, or what the method takes)", names_in(kShadowModes),
                   name_of(default_shadows(RenderSettings().method))),
       [](Options& o, Text t) { o.shadows = parse_name("--shadows", kShadowModes, t); }},
      {"--blur-kernel", "K", group,
       fmt::format("Pixels, odd, 1 to {} (default {})", kLargestBlurKernel_px, RenderSettings().blur_kernel_px),
       [](Options& o, Text t) {
         o.settings.blur_kernel_px = parse_whole("--blur-kernel", t, 1, kLargestBlurKernel_px);
         if (o.settings.blur_kernel_px % 2 == 0)
           throw error(ErrorKind::usage, "--blur-kernel {}: must be an odd number from 1 to {}", t,
                       kLargestBlurKernel_px);
       }},
      number("--shadow-map", "N", group, "Texels along each side", &RenderSettings::shadow_map_px, 1, kLargestSide_px),
      choice("--shadow-warp", "W", group,
             "lispsm: fitted to what is seen, finer nearby; uniform: fitted to the whole scene",
             &RenderSettings::shadow_warp, kShadowWarps),
      number("--samples", "N", group, "Samples per pixel, in a fixed pattern", &RenderSettings::samples, 1, 4096),
      {"--adaptive", "", group, "Takes the samples only where there are edges, and one elsewhere",
       [](Options& o, Text t) { o.settings.adaptive = parse_flag("--adaptive", t); }},
      number("--reflection-depth", "D", group, "Generations of rays after the first", &RenderSettings::reflection_depth,
             0, 64),
      choice("--accel", "A", group, names_in(kAccels), &RenderSettings::accel, kAccels),
  };
}

std::vector<RenderOption> machine() {
  const char* group = "Machine";
  return {
      {"--threads", "N", group, "Processors to use (default: all that are allowed)",
       [](Options& o, Text t) { o.threads = parse_whole("--threads", t, 1, 1024); }},
      {"--max-memory", "SIZE", group,
       "Refuse runs estimated to need more: 8G, 500M, none (default: all that the machine or its cgroup has)",
       [](Options& o, Text t) { o.most_bytes = parse_bytes("--max-memory", t); }},
      number("--frames-in-flight", "N", group, "Frames that GPU and CPU work on at once (1: pass after pass)",
             &RenderSettings::frames_in_flight, 1, 16),
      {"--gl", "WHERE", group,
       fmt::format(
           "{}: draw passes by OpenGL, also a software one, or compute them on the CPU (default auto: OpenGL on "
           "a GPU if there is one, else off)",
           names_in(kGlUses)),
       [](Options& o, Text t) { o.gl_use = parse_name("--gl", kGlUses, t); }},
      {"--device", "ID", group, "GL device, as 'hybridrt doctor' lists them",
       [](Options& o, Text t) { o.gl.device = t; }},
      {"--require-hardware", "", group, "Refuse software renderers",
       [](Options& o, Text t) { o.gl.require_hardware = parse_flag("--require-hardware", t); }},
      text("--config", "FILE", group,
           "JSON with more options by their names, as 'hybridrt tune' writes it; the command line takes precedence",
           &Options::config),
      text("--shaders", "DIR", group, "Folder to read the shaders from instead of the built-in ones",
           &Options::shaders),
  };
}

}  // namespace

std::vector<RenderOption> render_option_table() {
  std::vector<RenderOption> table;
  append(table, scene(), Affects::scene);
  append(table, frames(), Affects::run);
  append(table, camera_and_light(), Affects::view);
  append(table, picture(), Affects::view);
  append(table, method(), Affects::quality);
  append(table, machine(), Affects::quality);
  return table;
}

}  // namespace hybridrt::cli
