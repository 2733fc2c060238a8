#include <CLI/CLI.hpp>

#include "cli/option_values.h"
#include "cli/render_options.h"

namespace hybridrt::cli {
namespace {

const std::map<std::string, Method> kMethods = {{"hybrid", Method::hybrid},
                                                {"raster", Method::raster},
                                                {"raytrace", Method::raytrace},
                                                {"reference", Method::reference}};
const std::map<std::string, ShadowWarp> kWarps = {{"uniform", ShadowWarp::uniform}, {"lispsm", ShadowWarp::lispsm}};
const std::map<std::string, Accel> kAccels = {{"kdtree", Accel::kdtree}, {"embree", Accel::embree}};
const std::map<std::string, gl::Binding> kBindings = {
    {"auto", gl::Binding::any}, {"egl", gl::Binding::egl}, {"osmesa", gl::Binding::osmesa}};

}  // namespace

void add_render_options(CLI::App& app, RenderOptions& o) {
  app.add_option("scene", o.scene,
                 "OBJ, PLY, OFF or STL file, scene .json, or scene:spheres[,triangles=N,reflective=P]")
      ->required()
      ->type_name("SCENE");

  const char* camera = "Camera and light";
  app.add_option("--up-axis", o.up_axis,
                 "y (default) or z: which axis of the scene's files points up. Cameras and "
                 "lights are given in the files' axes too")
      ->type_name("AXIS")
      ->group(camera);
  app.add_option("--camera", o.camera, "Camera path: keyframes or an orbit, as JSON")->type_name("FILE")->group(camera);
  app.add_option("--eye", o.eye, "Still camera: where it stands (default: an orbit)")
      ->type_name("X,Y,Z")
      ->group(camera);
  app.add_option("--target", o.target, "Still camera: what it looks at (default: the scene's middle)")
      ->type_name("X,Y,Z")
      ->group(camera);
  app.add_option("--up", o.up, "Still camera: which way is up (default 0,1,0)")->type_name("X,Y,Z")->group(camera);
  app.add_option("--fov", o.fov_deg, "Vertical field of view, replaces a camera path's (default 45)")
      ->type_name("DEG")
      ->group(camera);
  app.add_option("--light", o.light,
                 "Direction toward the light, any length (default: from above, left of and "
                 "behind the first camera); replaces all lights of the scene and a camera path's")
      ->type_name("X,Y,Z")
      ->group(camera);
  app.add_option("--light-follows", o.light_follows,
                 "camera: the lights keep their places as seen from the camera "
                 "(turntables)")
      ->type_name("WHAT")
      ->group(camera);

  const char* picture = "Picture";
  app.add_option("--frames", o.frames, "100 (frames 1-100), 1-100, 1-100:5, 1-10,20,30-40 (default 1)")
      ->type_name("SPEC")
      ->group(picture);
  app.add_option("--sequence", o.sequence, "The whole that the frames belong to (default: first to last frame)")
      ->type_name("A-B")
      ->group(picture);
  app.add_option("--size", o.size, "Pixels (default 1024x768)")->type_name("WxH")->group(picture);
  app.add_option("--crop", o.crop, "Render this part of the frame only")->type_name("X,Y,W,H")->group(picture);
  app.add_option("--aov", o.aovs,
                 "Also write: id,shadow,marked,traced,depth,normal (files of their own; layers of an "
                 ".exr)")
      ->type_name("LIST")
      ->group(picture);

  const char* method = "Method";
  app.add_option_function("--method", by_name("--method", kMethods, o.method),
                          "hybrid (default), raster, raytrace, reference")
      ->type_name("M")
      ->group(method);
  app.add_option("--shadows", o.shadows, "none, map, blur, exact, rays (default: exact, or what the method takes)")
      ->type_name("S")
      ->group(method);
  app.add_option("--blur-kernel", o.blur_kernel, "Odd, 1-31 pixels (default 5)")->type_name("K")->group(method);
  app.add_option("--shadow-map", o.shadow_map, "Texels along each side (default 2048)")->type_name("N")->group(method);
  app.add_option_function("--shadow-warp", by_name("--shadow-warp", kWarps, o.shadow_warp),
                          "lispsm (default): fitted to what is seen, more of it nearby; uniform: to the whole scene")
      ->type_name("W")
      ->group(method);
  app.add_option("--samples", o.samples, "Samples a pixel, 1-4096, in a fixed pattern (default 1)")
      ->type_name("N")
      ->group(method);
  app.add_option("--reflection-depth", o.reflection_depth, "Generations of rays after the first, 0-64 (default 4)")
      ->type_name("D")
      ->group(method);
  app.add_option_function("--accel", by_name("--accel", kAccels, o.accel), "embree (default), kdtree")
      ->type_name("A")
      ->group(method);

  const char* machine = "Machine";
  app.add_option("--threads", o.threads, "Processors to use (default: all that are allowed)")
      ->type_name("N")
      ->group(machine);
  app.add_option("--max-memory", o.max_memory,
                 "What needs more is refused, by an estimate: 8G, 500M, none (default: "
                 "all that the machine or its cgroup has)")
      ->type_name("SIZE")
      ->group(machine);
  app.add_option("--frames-in-flight", o.frames_in_flight,
                 "1: pass after pass; 2 (default): GPU and CPU work on "
                 "neighbouring frames")
      ->type_name("N")
      ->group(machine);
  app.add_option_function("--gl", by_name("--gl", kBindings, o.gl), "auto (default), egl, osmesa")
      ->type_name("BINDING")
      ->group(machine);
  app.add_option("--device", o.device, "GL device, as 'hybridrt doctor' lists them")->type_name("ID")->group(machine);
  app.add_flag("--require-hardware", o.require_hardware, "Refuse software renderers")->group(machine);
  app.add_option("--shaders", o.shaders, "Folder to read the shaders from instead of the built-in ones")
      ->type_name("DIR")
      ->group(machine);

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

}  // namespace hybridrt::cli
