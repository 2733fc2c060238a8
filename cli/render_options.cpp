#include "cli/render_options.h"

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/render/default_view.h"
#include "core/render/memory_estimate.h"
#include "core/scene/loading_bytes.h"
#include "core/scene/scene_file.h"
#include "core/scene/procedural.h"
#include "core/scene/scene_source.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

namespace hybridrt::cli {
namespace {

constexpr int kLargestSide_px = 65536;

const std::map<std::string, Method> kMethods = {{"hybrid", Method::hybrid},
                                                {"raster", Method::raster},
                                                {"raytrace", Method::raytrace},
                                                {"reference", Method::reference}};
const std::map<std::string, ShadowMode> kShadows = {
    {"none", ShadowMode::none}, {"map", ShadowMode::map}, {"blur", ShadowMode::blur}, {"rays", ShadowMode::rays}};
const std::map<std::string, Accel> kAccels = {{"kdtree", Accel::kdtree}, {"embree", Accel::embree}};
const std::map<std::string, gl::Binding> kBindings = {
    {"auto", gl::Binding::any}, {"egl", gl::Binding::egl}, {"osmesa", gl::Binding::osmesa}};
const std::map<std::string, uint32_t> kAovs = {{"id", kAovId},         {"shadow", kAovShadow}, {"marked", kAovMarked},
                                               {"traced", kAovTraced}, {"depth", kAovDepth},   {"normal", kAovNormal}};

template <typename Value>
std::string names(const std::map<std::string, Value>& table) {
  std::string list;
  for (const auto& [name, value] : table) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Reads the value by name; CLI11's own messages would show C++ type names.
template <typename Value>
std::function<void(const std::string&)> by_name(const char* option, const std::map<std::string, Value>& table,
                                                Value& out) {
  return [option, &table, &out](const std::string& text) {
    const auto found = table.find(text);
    if (found == table.end())
      throw error(ErrorKind::usage, "{} {}: not known; one of {}", option, text, names(table));
    out = found->second;
  };
}

template <typename Number>
bool parse_number(std::string_view text, Number& out) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), out);
  return problem == std::errc{} && end == text.data() + text.size();
}

dvec3 parse_vector(const char* option, const std::string& text) {
  dvec3 v(0);
  const size_t first = text.find(','), second = text.find(',', first + 1);
  const std::string_view whole = text;
  if (first == std::string::npos || second == std::string::npos || !parse_number(whole.substr(0, first), v.x) ||
      !parse_number(whole.substr(first + 1, second - first - 1), v.y) ||
      !parse_number(whole.substr(second + 1), v.z) || !all_finite(v))
    throw error(ErrorKind::usage, "{} {}: write three numbers, like 1,2.5,-3", option, text);
  return v;
}

void parse_size(const std::string& text, RenderSettings& settings) {
  const size_t cross = text.find('x');
  int width = 0, height = 0;
  if (cross == std::string::npos || !parse_number(std::string_view(text).substr(0, cross), width) ||
      !parse_number(std::string_view(text).substr(cross + 1), height) || width < 1 || height < 1 ||
      width > kLargestSide_px || height > kLargestSide_px)
    throw error(ErrorKind::usage, "--size {}: write WIDTHxHEIGHT, each 1 to {}, like 1024x768", text, kLargestSide_px);
  settings.width_px = width;
  settings.height_px = height;
}

void parse_crop(const std::string& text, RenderSettings& settings) {
  int numbers[4] = {};
  std::string_view rest = text;
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    const size_t comma = i < 3 ? rest.find(',') : rest.size();
    good = comma != rest.npos && parse_number(rest.substr(0, comma), numbers[i]);
    if (good && i < 3) rest.remove_prefix(comma + 1);
  }
  if (!good) throw error(ErrorKind::usage, "--crop {}: write X,Y,W,H in pixels, like 100,50,320,240", text);
  const PixelRect crop{numbers[0], numbers[1], numbers[2], numbers[3]};
  if (crop.x_px < 0 || crop.y_px < 0 || crop.width_px < 1 || crop.height_px < 1 ||
      crop.x_px > settings.width_px - crop.width_px || crop.y_px > settings.height_px - crop.height_px)
    throw error(ErrorKind::usage, "--crop {}: it must lie inside the frame of {}x{} pixels", text, settings.width_px,
                settings.height_px);
  settings.crop = crop;
}

uint32_t parse_aovs(const std::string& text) {
  uint32_t bits = 0;
  for (size_t begin = 0; !text.empty() && begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    const auto found = kAovs.find(name);
    if (found == kAovs.end()) throw error(ErrorKind::usage, "--aov {}: not known; any of {}", name, names(kAovs));
    bits |= found->second;
    begin = end + 1;
  }
  return bits;
}

void require_range(const char* option, long long value, long long lowest, long long highest) {
  if (value < lowest || value > highest)
    throw error(ErrorKind::usage, "{} {}: allowed are {} to {}", option, value, lowest, highest);
}

RenderSettings make_settings(const RenderOptions& o) {
  RenderSettings s;
  parse_size(o.size, s);
  if (!o.crop.empty()) parse_crop(o.crop, s);
  s.method = o.method;
  s.shadows = default_shadows(o.method);
  if (!o.shadows.empty()) by_name("--shadows", kShadows, s.shadows)(o.shadows);
  require_method_takes(s.method, s.shadows);
  require_range("--blur-kernel", o.blur_kernel, 1, 31);
  if (o.blur_kernel % 2 == 0)
    throw error(ErrorKind::usage, "--blur-kernel {}: it must be odd, 1 to 31", o.blur_kernel);
  require_range("--shadow-map", o.shadow_map, 1, kLargestSide_px);
  require_range("--reflection-depth", o.reflection_depth, 0, 64);
  require_range("--frames-in-flight", o.frames_in_flight, 1, 16);
  s.blur_kernel_px = o.blur_kernel;
  s.shadow_map_px = o.shadow_map;
  s.reflection_depth = o.reflection_depth;
  s.frames_in_flight = o.frames_in_flight;
  s.aovs = parse_aovs(o.aovs);
  return s;
}

/// Bytes: a number and K, M, G or T (of 1024), with or without B or iB behind it.
uint64_t parse_max_memory(const std::string& text) {
  if (text.empty()) return allowed_memory();
  if (text == "none") return std::numeric_limits<uint64_t>::max();
  constexpr std::string_view kUnits = "KMGT";
  double bytes = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, bytes);
  std::string_view rest(stop, static_cast<size_t>(end - stop));
  if (!rest.empty() && kUnits.find(rest.front()) != kUnits.npos) {
    bytes *= std::exp2(10.0 * static_cast<double>(1 + kUnits.find(rest.front())));
    rest.remove_prefix(1);
    if (rest == "B" || rest == "iB") rest = {};
  }
  if (status != std::errc() || !rest.empty() || !(bytes >= 1 && bytes < 1e18))
    throw error(ErrorKind::usage, "--max-memory {}: write a number with K, M, G or T behind it, like 8G, or none", text);
  return static_cast<uint64_t>(bytes);
}

std::optional<UpAxis> parse_up_axis(const RenderOptions& o) {
  if (o.up_axis.empty()) return std::nullopt;
  if (o.up_axis != "y" && o.up_axis != "z")
    throw error(ErrorKind::usage, "--up-axis {}: not known; one of y, z", o.up_axis);
  return o.up_axis == "y" ? UpAxis::y : UpAxis::z;
}

FrameRange make_sequence(const RenderOptions& o, const FrameSpec& frames) {
  if (o.sequence.empty()) return {frames.lowest(), frames.highest(), 1};
  const FrameRange sequence = parse_sequence(o.sequence);
  if (frames.lowest() < sequence.first || frames.highest() > sequence.last)
    throw error(ErrorKind::usage, "--frames {} is not a part of --sequence {}", o.frames, o.sequence);
  return sequence;
}

constexpr double kDefaultFov_deg = 45;

double fov_y_rad(const RenderOptions& o) {
  const double degrees = o.fov_deg.value_or(kDefaultFov_deg);
  if (!(degrees > 0 && degrees < 180))
    throw error(ErrorKind::usage, "--fov {}: allowed is more than 0 and less than 180 degrees", degrees);
  return degrees * kPi / 180;
}

/// --eye, --target, --up; `middle` is what to look at when nothing is said.
Camera still_camera(const RenderOptions& o, UpAxis up_axis, const dvec3& middle, Warnings& warnings) {
  Camera still;
  still.eye_world = y_up_from_files(up_axis, parse_vector("--eye", o.eye));
  still.target_world = o.target.empty() ? middle : y_up_from_files(up_axis, parse_vector("--target", o.target));
  if (!o.up.empty()) still.up = y_up_from_files(up_axis, parse_vector("--up", o.up));
  if (still.eye_world == still.target_world)
    throw error(ErrorKind::usage, "--eye and --target are the same point; move one of them");
  if (still.up == dvec3(0)) throw error(ErrorKind::usage, "--up {}: it must not be zero", o.up);
  if (up_is_along_view(still))
    warnings.push_back("the camera looks along its up direction; another up is used");
  return still;
}

void set_fov(CameraCourse& course, double fov) {
  if (auto* still = std::get_if<Camera>(&course)) still->fov_y_rad = fov;
  if (auto* orbit = std::get_if<Orbit>(&course)) orbit->fov_y_rad = fov;
  if (auto* path = std::get_if<CameraPath>(&course))
    for (CameraKey& key : path->keys) key.camera.fov_y_rad = fov;
}

/// The camera that flags ask for, or else the scene's own, or else an orbit.
CameraCourse make_course(const RenderOptions& o, RenderJob& job, UpAxis up_axis, Surroundings& surroundings,
                         ThreadPool& pool, Warnings& warnings) {
  const double fov = fov_y_rad(o);
  std::optional<CameraCourse> of_scene;
  if (o.camera.empty() && o.eye.empty() && is_scene_file(o.scene))
    of_scene = read_scene_file_camera(o.scene, {up_axis, fov}, warnings);
  if (o.eye.empty() && !(o.target.empty() && o.up.empty()))
    throw error(ErrorKind::usage, "--target and --up describe a still camera; give --eye X,Y,Z too");
  if (!o.camera.empty() && !o.eye.empty())
    throw error(ErrorKind::usage, "--camera and --eye both say where the camera is; give one of them");
  CameraCourse course;
  if (!o.camera.empty()) {
    course = read_camera_file(o.camera, {up_axis, fov}, warnings);
  } else if (of_scene) {
    course = *of_scene;
  } else {
    const double aspect = static_cast<double>(job.settings.width_px) / job.settings.height_px;
    const SceneShot shot = shot_of(o.scene);
    if (o.eye.empty() && shot.camera) {
      course = orbit_through(*shot.camera);
      if (o.fov_deg) set_fov(course, fov);
      return course;
    }
    if (o.eye.empty()) {
      job.caster = make_scene_caster(job.scene, job.accel, pool);
      const DefaultView view = choose_default_view(job.scene, *job.caster.caster, aspect, fov);
      surroundings = view.surroundings;
      course = view.orbit;
    } else {
      course = still_camera(o, up_axis, default_orbit(job.scene, aspect, fov).target_world, warnings);
    }
  }
  if (o.fov_deg || !o.eye.empty()) set_fov(course, fov);
  return course;
}

LightMotion make_light(const RenderOptions& o, const RenderJob& job, UpAxis up_axis,
                       const std::optional<DirectionalLight>& of_scene, Surroundings surroundings) {
  const int first = job.motion.sequence.first;
  const auto* path = std::get_if<CameraPath>(&job.motion.course);
  const std::optional<dvec3> keyed = path ? light_on_path(*path, first) : std::nullopt;
  LightMotion motion;
  motion.light = default_light(surroundings, camera_at(job.motion, first), job.settings.ambient);
  if (of_scene) motion.light.color = of_scene->color;
  if (!o.light.empty()) {
    const dvec3 toward = parse_vector("--light", o.light);
    if (toward == dvec3(0)) throw error(ErrorKind::usage, "--light {}: it must not be zero", o.light);
    const double largest = std::max({std::abs(toward.x), std::abs(toward.y), std::abs(toward.z)});
    motion.light.toward = glm::normalize(y_up_from_files(up_axis, toward / largest));  // any length: squares overflow
  } else if (keyed) {
    motion.light.toward = *keyed;
    motion.mode = LightMode::with_path;
  } else if (of_scene) {
    motion.light.toward = y_up_from_files(up_axis, of_scene->toward);
  } else if (surroundings == Surroundings::inside) {
    motion.mode = LightMode::with_camera;
  }
  if (!o.light.empty() || keyed || of_scene) motion.light.casts_shadow = true;
  if (o.light_follows.empty()) return motion;
  if (o.light_follows != "camera")
    throw error(ErrorKind::usage, "--light-follows {}: not known; one of camera", o.light_follows);
  if (motion.mode == LightMode::with_path)
    throw error(ErrorKind::usage,
                "--light-follows camera: the camera path's keys move the light already; replace it by --light X,Y,Z");
  motion.mode = LightMode::with_camera;
  return motion;
}

}  // namespace

void add_render_options(CLI::App& app, RenderOptions& o) {
  app.add_option("scene", o.scene, "OBJ, PLY, OFF or STL file, scene .json, or scene:spheres[,triangles=N,reflective=P]")->required()->type_name("SCENE");

  const char* camera = "Camera and light";
  app.add_option("--up-axis", o.up_axis, "y (default) or z: which axis of the scene's files points up. Cameras and "
                 "lights are given in the files' axes too")->type_name("AXIS")->group(camera);
  app.add_option("--camera", o.camera, "Camera path: keyframes or an orbit, as JSON")->type_name("FILE")->group(camera);
  app.add_option("--eye", o.eye, "Still camera: where it stands (default: an orbit)")->type_name("X,Y,Z")->group(camera);
  app.add_option("--target", o.target, "Still camera: what it looks at (default: the scene's middle)")
      ->type_name("X,Y,Z")->group(camera);
  app.add_option("--up", o.up, "Still camera: which way is up (default 0,1,0)")->type_name("X,Y,Z")->group(camera);
  app.add_option("--fov", o.fov_deg, "Vertical field of view, replaces a camera path's (default 45)")->type_name("DEG")->group(camera);
  app.add_option("--light", o.light, "Direction toward the light, any length (default: from above, left of and "
                 "behind the first camera); replaces a camera path's")->type_name("X,Y,Z")->group(camera);
  app.add_option("--light-follows", o.light_follows, "camera: the light keeps its place as seen from the camera "
                 "(turntables)")->type_name("WHAT")->group(camera);

  const char* picture = "Picture";
  app.add_option("--frames", o.frames, "100 (frames 1-100), 1-100, 1-100:5, 1-10,20,30-40 (default 1)")
      ->type_name("SPEC")->group(picture);
  app.add_option("--sequence", o.sequence, "The whole that the frames belong to (default: first to last frame)")
      ->type_name("A-B")->group(picture);
  app.add_option("--size", o.size, "Pixels (default 1024x768)")->type_name("WxH")->group(picture);
  app.add_option("--crop", o.crop, "Render this part of the frame only")->type_name("X,Y,W,H")->group(picture);
  app.add_option("--aov", o.aovs, "Also write: id,shadow,marked,traced,depth,normal (files of their own; layers of an "
                 ".exr)")->type_name("LIST")->group(picture);

  const char* method = "Method";
  app.add_option_function("--method", by_name("--method", kMethods, o.method),
                          "hybrid (default), raster, raytrace, reference")->type_name("M")->group(method);
  app.add_option("--shadows", o.shadows, "none, map, blur, rays (default: blur, or what the method takes)")
      ->type_name("S")->group(method);
  app.add_option("--blur-kernel", o.blur_kernel, "Odd, 1-31 pixels (default 5)")->type_name("K")->group(method);
  app.add_option("--shadow-map", o.shadow_map, "Texels along each side (default 2048)")->type_name("N")->group(method);
  app.add_option("--reflection-depth", o.reflection_depth, "Generations of rays after the first, 0-64 (default 4)")
      ->type_name("D")->group(method);
  app.add_option_function("--accel", by_name("--accel", kAccels, o.accel), "embree (default), kdtree")
      ->type_name("A")->group(method);

  const char* machine = "Machine";
  app.add_option("--threads", o.threads, "Processors to use (default: all that are allowed)")->type_name("N")->group(machine);
  app.add_option("--max-memory", o.max_memory, "What needs more is refused, by an estimate: 8G, 500M, none (default: "
                 "all that the machine or its cgroup has)")->type_name("SIZE")->group(machine);
  app.add_option("--frames-in-flight", o.frames_in_flight, "1: pass after pass; 2 (default): GPU and CPU work on "
                 "neighbouring frames")->type_name("N")->group(machine);
  app.add_option_function("--gl", by_name("--gl", kBindings, o.gl), "auto (default), egl, osmesa")
      ->type_name("BINDING")->group(machine);
  app.add_option("--device", o.device, "GL device, as 'hybridrt doctor' lists them")->type_name("ID")->group(machine);
  app.add_flag("--require-hardware", o.require_hardware, "Refuse software renderers")->group(machine);
  app.add_option("--shaders", o.shaders, "Folder to read the shaders from instead of the built-in ones")
      ->type_name("DIR")->group(machine);

  const std::vector<CLI::Option*> ours = app.get_options();
  app.parse_complete_callback([ours, &o] {
    o.given.clear();
    for (const CLI::Option* option : ours) {
      const std::string name = option->get_name(false, false);
      if (option->count() == 0 || !name.starts_with("--") || name == "--help") continue;
      o.given.emplace_back(name, option->results().back());
    }
  });
}

RenderOptions with_scene_settings(const RenderOptions& options) {
  if (!is_scene_file(options.scene) || options.scene.starts_with("scene:")) return options;
  const SceneDescription scene = read_scene_file(options.scene);
  if (scene.settings.empty()) return options;

  // Parsed twice: alone, so that what is wrong is the file's fault, and below what the command line gave.
  const auto parsed = [](const std::vector<std::pair<std::string, std::string>>& settings, RenderOptions& into) {
    CLI::App parser;
    add_render_options(parser, into);
    std::vector<std::string> arguments;  // CLI11 takes them backwards
    for (const auto& [name, value] : settings) {
      const CLI::Option* option = parser.get_option_no_throw(name);
      if (!option || name == "--help") throw error(ErrorKind::usage, "there is no render option '{}'", name.substr(2));
      if (option->get_items_expected_max() == 0 && value == "false") continue;
      arguments.push_back(option->get_items_expected_max() == 0 ? name : name + "=" + value);
    }
    arguments.push_back(into.scene);
    std::reverse(arguments.begin(), arguments.end());
    parser.parse(arguments);
  };
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [name, value] : scene.settings) all.emplace_back("--" + name, value);
  try {
    RenderOptions alone;
    alone.scene = options.scene;
    parsed(all, alone);
    make_settings(alone);
    parse_frame_spec(alone.frames);
  } catch (const CLI::ParseError& problem) {
    throw error(ErrorKind::input, "{}: settings: {}", options.scene, problem.what());
  } catch (const Error& problem) {
    throw error(ErrorKind::input, "{}: settings: {}", options.scene, problem.what());
  }
  std::erase_if(all, [&](const auto& setting) {
    return std::any_of(options.given.begin(), options.given.end(),
                       [&](const auto& given) { return given.first == setting.first; });
  });
  all.insert(all.end(), options.given.begin(), options.given.end());
  RenderOptions merged;
  merged.scene = options.scene;
  parsed(all, merged);
  merged.given = options.given;
  return merged;
}

RenderJob make_render_job(const RenderOptions& command_line, Warnings& warnings, LoadProgress* progress) {
  const RenderOptions o = with_scene_settings(command_line);
  const SceneDescription scene = is_scene_file(o.scene) ? read_scene_file(o.scene) : SceneDescription();
  const std::optional<UpAxis> up_axis = parse_up_axis(o);
  const UpAxis up = up_axis ? *up_axis : scene.up_axis.value_or(UpAxis::y);
  RenderJob job;
  job.settings = make_settings(o);
  const SceneShot shot = shot_of(o.scene);
  job.settings.ambient = scene.ambient.value_or(shot.ambient.value_or(job.settings.ambient));
  job.settings.background = scene.background.value_or(shot.background.value_or(job.settings.background));
  job.frames = parse_frame_spec(o.frames);
  if (o.threads) require_range("--threads", *o.threads, 1, 1024);
  job.threads = o.threads.value_or(allowed_processors());
  job.accel = o.accel;
  job.gl = {o.gl, o.device, o.require_hardware, 0};
  job.shaders = o.shaders.empty() ? gl::embedded_shaders() : gl::load_shaders(o.shaders);

  job.most_bytes = parse_max_memory(o.max_memory);
  require_room_for_frames(job.settings, job.threads, job.frames.count(), job.most_bytes);

  ThreadPool pool(job.threads);
  job.scene = load_scene(o.scene, pool, warnings, up_axis, {job.most_bytes, progress});
  require_room_for_scene(o.scene, estimate_memory(job.scene, make_scene_facts(job.scene), job.settings, job.accel,
                                                  job.threads, job.frames.count()).total(), job.most_bytes);
  job.motion.sequence = make_sequence(o, job.frames);
  Surroundings surroundings = Surroundings::outside;
  job.motion.course = make_course(o, job, up, surroundings, pool, warnings);
  job.light = make_light(o, job, up, scene.light ? scene.light : shot.light, surroundings);
  return job;
}

}  // namespace hybridrt::cli
