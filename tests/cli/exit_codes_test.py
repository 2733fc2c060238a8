"""Bad input gets its exit code and one line that says what, where and what to do."""

import os
import re
import resource
import stat
import unittest

from cli_test_case import SCENE, SMALL, CliTestCase

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


class CommandLineTest(CliTestCase):
    def refuse(self, *arguments, says):
        self.fail_with(2, "render", SCENE, *arguments, says=says)
        self.assertEqual(self.files(), [], "refused before anything was written")

    def test_frames(self):
        self.refuse("--frames", "10-1", says=("10-1", "lower frame first"))
        self.refuse("--frames", "1-10,10-20", says=("overlap",))
        self.refuse("--frames", "1-10,5", says=("overlap",))
        for frames in ("0", "x", "1-", "1-5:0", "1,,2", "99999999999"):
            self.refuse("--frames", frames, says="frames '" + frames)
        self.refuse("--frames", "1-10", "--sequence", "5-20", says=("--sequence 5-20", "1-10"))
        self.refuse("--frames", "1-10", "--sequence", "20-5", says="20-5")

    def test_numbers_out_of_range(self):
        self.refuse("--threads", "0", says=("--threads", "1 to"))
        self.refuse("--threads=-1", says=("--threads", "1 to"))
        self.refuse("--blur-kernel", "4", says=("--blur-kernel 4", "odd"))
        self.refuse("--blur-kernel", "33", says=("--blur-kernel 33", "31"))
        self.refuse("--blur-kernel", "0", says="--blur-kernel 0")
        self.refuse("--reflection-depth=-1", says=("--reflection-depth -1", "0 to 64"))
        self.refuse("--reflection-depth", "65", says="0 to 64")
        self.refuse("--frames-in-flight", "0", says="--frames-in-flight 0")
        self.refuse("--shadow-map", "0", says="--shadow-map 0")
        self.refuse("--shadow-warp", "tsm", says=("--shadow-warp tsm", "uniform, lispsm"))
        self.refuse("--threads", "1e9", says="--threads")
        self.refuse("--threads", "99999999999999999999", says="--threads")

    def test_sizes(self):
        for size in ("0x0", "1000000000x1", "1e9x1", "64x-1", "64", "64x", "x64", "64x64x64", "64 x 64", ""):
            self.refuse("--size", size, says="--size")
        self.refuse("--size", "0x0", says=("WIDTHxHEIGHT", "1024x768"))

    def test_cameras(self):
        for fov in ("0", "180", "-5", "nan", "inf", "x"):
            self.refuse("--fov=" + fov, says="--fov")
        self.refuse("--eye", "1,2", says=("--eye 1,2", "three numbers"))
        for vector in ("1,2,x", "nan,1,2", "1,2,3,4", "1 2 3"):
            self.refuse("--light=" + vector, says="--light")
        self.refuse("--light", "0,0,0", says="--light")
        self.refuse("--eye", "1,1,1", "--up", "0,0,0", says="--up")
        self.refuse("--target", "1,1,1", says="--eye")
        self.refuse("--camera", "c.json", "--eye", "1,1,1", says="--camera and --eye")
        self.refuse("--eye", "1,1,1", "--target", "1,1,1", says=("--eye", "--target", "same point"))

    def test_up_along_the_view_is_a_warning(self):
        done = self.succeed("render", SCENE, *SMALL, "--eye", "0,9,0", "--target", "0,0,0", "-q")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("warning", done.stderr)
        self.assertIn("up", done.stderr)

    def test_names(self):
        self.refuse("--method", "magic", says=("--method magic", "raytrace"))
        self.refuse("--shadows", "soft", says=("--shadows soft", "blur"))
        self.refuse("--accel", "bvh", says=("--accel bvh", "embree"))
        self.refuse("--gl", "vulkan", says=("--gl vulkan", "osmesa"))
        self.refuse("--aov", "id,beauty", says=("beauty", "depth"))

    def test_methods_and_shadows(self):
        for method, shadows in (("raster", "blur"), ("raster", "rays"), ("raytrace", "map"), ("raytrace", "blur"),
                                ("reference", "map"), ("reference", "blur")):
            self.refuse("--method", method, "--shadows", shadows, says=(method, shadows))

    def test_unknown_options_name_the_nearest(self):
        self.refuse("--frmaes", "3", says=("--frmaes", "did you mean --frames?"))
        self.refuse("--shadow", "map", says=("--shadow", "--shadows"))
        self.refuse("--thread=3", says="--threads")
        self.refuse("surplus", says="surplus")
        self.fail_with(2, "rendre", SCENE, says="rendre")
        self.fail_with(2, "render", says="scene")
        self.fail_with(2, "doctor", "--jsno", says="--json")
        self.fail_with(2, "scene", "sphere", "-o", "x.obj", says=("sphere", "spheres"))

    def test_options_given_twice_or_without_a_value(self):
        self.refuse("--size", "8x8", "--size=9x9", says="--size is given 2 times (8x8, 9x9); give it once")
        self.refuse("--method", "raster", "--method", "raster", "--method", "hybrid", says="--method is given 3 times")
        self.refuse("-o", "a.png", "--output", "b.png", says="--output is given 2 times (a.png, b.png); give it once")
        self.refuse("--size", says="--size has no value; write --size WxH")
        self.refuse("--threads", "many", says="--threads many: must be a whole number from 1 to 1024")
        self.fail_with(2, "golden", "check", "--list", "a", "--list", "b", says="--list is given 2 times (a, b)")
        self.succeed("render", SCENE, *SMALL, "-q", "-q", "-o", "flags may be repeated.png")

    def test_formats_are_refused_before_rendering(self):
        for name in ("x.xyz", "x.null", "noextension", "x."):
            self.refuse("-o", name, says=(name, ".png"))
        self.refuse("-o", "folder/", says="folder/")
        self.refuse("-o", "{frame:x}.png", says="{frame")
        self.refuse("--contact-sheet", "sheet.xyz", says="sheet.xyz")

    def test_one_standard_output_cannot_hold_both(self):
        self.refuse("--timings", "-", "--json", says=("--timings", "--json"))

    def test_help_and_nothing(self):
        for arguments in (("--help",), ("help",), ("render", "--help"), ("help", "render")):
            self.assertIn("render", self.succeed(*arguments).stdout)
        self.assertEqual(self.succeed("help", "golden").stdout, self.succeed("golden", "--help").stdout)
        self.fail_with(2, "help", "redner", says=("redner", "hybridrt help"))
        bare = self.run_binary()
        self.assertEqual((bare.returncode, bare.stdout), (2, ""))
        self.assertIn("render", bare.stderr)

    def test_marks_of_other_programs(self):
        for mark in ("$F4", "@@@@"):
            self.refuse("--frames", "2", "-o", f"a.{mark}.png", says=(mark[:1], "a.####.png"))
        self.refuse("-o", "", says="output")
        self.succeed("render", SCENE, *SMALL, "-q", "--frames", "2", "-o", "a.%03d.png")
        self.assertTrue(os.path.exists(self.path("a.002.png")), self.files())
        for mark in ("$F4", "@@@@"):
            self.succeed("render", SCENE, *SMALL, "-q", "--frames", "2", "-o", f"b{mark}.##.png")
            self.succeed("render", SCENE, *SMALL, "-q", "-o", f"one{mark}.png")
            self.assertIn(f"one{mark}.png", self.files())

    def test_gl_overrides_are_named(self):
        self.fail_with(4, "render", SCENE, *SMALL, "--gl", "egl", env={"MESA_GL_VERSION_OVERRIDE": "2.1"},
                       says=("MESA_GL_VERSION_OVERRIDE=2.1", "unset"))


class SceneTest(CliTestCase):
    def test_scenes_that_cannot_be(self):
        os.mkdir(self.path("folder.obj"))
        self.write("empty.obj", "")
        self.write("points.obj", "v 0 0 0\n")
        self.write("index.obj", TRIANGLE + "f 1 2 4\n")
        self.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")
        for name in ("missing.obj", "folder.obj", "empty.obj", "points.obj", "index.obj", "nan.obj"):
            self.fail_with(3, "render", name, *SMALL, says=name)
        self.fail_with(3, "render", "index.obj", *SMALL, says="index.obj:5")
        self.fail_with(3, "render", "nan.obj", *SMALL, says="nan.obj:2")
        self.fail_with(2, "render", "scene:cubes", *SMALL, says=("cubes", "spheres"))
        self.fail_with(2, "render", "scene:spheres,triangles=1", *SMALL, says="triangles")
        self.fail_with(2, "render", "scene:spheres,colour=red", *SMALL, says="colour")
        self.assertFalse(os.path.exists(self.path("out")))


class DeviceTest(CliTestCase):
    def refuse(self, *arguments, says, **keywords):
        self.fail_with(4, "render", SCENE, *arguments, says=says, **keywords)

    def test_bad_device(self):
        self.refuse("--device", "egl:99", says=("egl:99", "doctor"))
        self.refuse("--gl", "egl", "--device", "osmesa", says="osmesa")

    def test_no_egl_vendor_says_what_was_tried(self):
        self.refuse("--gl", "egl", says=("tried", "--gl off"),
                    env={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent.json"})

    def test_off_loads_no_gl(self):
        done = self.succeed("render", SCENE, *SMALL, "-q", "--gl", "off", env={"LD_DEBUG": "libs"})
        loaded = [line for line in done.stderr.splitlines() if "calling init" in line]
        self.assertTrue(any("libembree" in line for line in loaded))
        for library in ("libEGL", "libOSMesa", "gallium", "swrast", "libLLVM"):  # OpenImageIO may load libGL itself
            self.assertFalse(any(library in line for line in loaded), library)

    def test_off_contradicts_what_asks_for_a_gl(self):
        self.fail_with(2, "render", SCENE, "--gl", "off", "--device", "egl:0", says=("--gl off", "--device"))
        self.fail_with(2, "render", SCENE, "--gl", "off", "--require-hardware", says="--require-hardware")
        self.refuse("--require-hardware", env={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent.json"}, says="tried")

    def test_no_shadow_mode_needs_a_gl(self):
        for shadows in ("none", "map", "blur", "exact", "rays"):
            self.render("--shadows", shadows, "--gl", "off", env={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent.json"})

    def test_raytracing_needs_no_gl(self):
        self.render("--method", "raytrace", env={"__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent.json"})

    def test_size_over_the_limit_names_it(self):
        self.refuse("--gl", "egl", "--size", "65536x2", says=("65536", "GL_MAX_TEXTURE_SIZE"))
        self.refuse("--gl", "egl", "--size", "2x65536", says=("65536", "GL_MAX_TEXTURE_SIZE"))
        self.refuse("--gl", "egl", "--size", "8x8", "--shadow-map", "65536", "--max-memory", "none", says=("65536", "GL_MAX_TEXTURE_SIZE"))

    def test_broken_shader_shows_the_log(self):
        shaders = os.path.join(os.path.dirname(__file__), "..", "..", "shaders")
        os.mkdir(self.path("shaders"))
        for name in os.listdir(shaders):
            with open(os.path.join(shaders, name), encoding="utf-8") as file:
                self.write(os.path.join("shaders", name), file.read())
        self.render("--shaders", "shaders")
        self.write("shaders/shade.comp", "#version 450 core\nvoid main() { undeclared_thing = 1; other = 2; }\n")
        self.refuse("--shaders", "shaders", says=("shade.comp", "undeclared_thing"))
        os.remove(self.path("shaders/shared.h"))
        self.fail_with(3, "render", SCENE, "--shaders", "shaders", says=("--shaders shaders: ", "shared.h"))
        for folder in ("nowhere", "/etc"):
            self.fail_with(3, "render", SCENE, "--shaders", folder, says=(f"--shaders {folder}: ", "leave --shaders out"))


class DocumentationTest(unittest.TestCase):
    def test_it_lists_every_code_and_no_other(self):
        top = os.path.join(os.path.dirname(__file__), "..", "..")
        with open(os.path.join(top, "cli", "exit_codes.h"), encoding="utf-8") as header:
            ours = re.findall(r"^  \w+ = (\d+),", header.read(), re.MULTILINE)
        with open(os.path.join(top, "README.md"), encoding="utf-8") as readme:
            listed = readme.read().split("## Exit codes\n\n")[1].split(" An error is ")[0].replace("\n", " ")
        self.assertEqual([code for entry in listed.split(" · ") for code in re.findall(r"\d+", entry)], ours)


class SystemTest(CliTestCase):
    def refuse(self, *arguments, says):
        self.fail_with(5, "render", SCENE, *SMALL, "-q", *arguments, says=says)

    def test_missing_folders_are_made(self):
        self.render("-o", "a/b/c/x.png")
        self.assertIn("a/b/c/x.png", self.files())

    def test_folder_that_is_a_file(self):
        self.write("file", "keep me")
        self.refuse("-o", "file/x.png", says="file")
        self.refuse("-o", "x.png", "--timings", "file/t.csv", says="file/t.csv")
        self.refuse("-o", "x.png", "--contact-sheet", "file/s.png", says="file/s.png")
        os.mkdir(self.path("folder.png"))
        self.refuse("-o", "x.png", "--contact-sheet", "folder.png", says="folder.png")
        self.assertEqual(self.read("file"), b"keep me")
        self.assertEqual(self.files(), ["file"], "refused before rendering")

    @unittest.skipUnless(os.path.exists("/dev/full"), "there is no /dev/full")
    def test_full_disk(self):
        self.refuse("-o", "x.png", "--timings", "/dev/full", says=("/dev/full", "No space left"))
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/full").st_mode), "the device was replaced by a file")

    def test_out_of_memory(self):
        def bounded():
            resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))

        self.fail_with(2, "render", SCENE, "--method", "raytrace", "--size", "20000x20000", "--max-memory", "none",
                       says=("out of memory", "smaller"), preexec_fn=bounded)

    def test_picture_where_a_folder_is(self):
        os.makedirs(self.path("x.png", "inside"))
        self.refuse("-o", "x.png", says="x.png")
        self.assertEqual([name for name in self.files() if "tmp" in name], [])


if __name__ == "__main__":
    unittest.main()
